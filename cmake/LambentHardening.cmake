# What optimised builds are hardened by: addresses that differ from run to run, checked sizes in
# memcpy and its kin, canaries on the stack, and no table of functions that can be written to.
# Sanitizers see more and do not go together with the checked functions.
#
# For everything in and below the folder that includes this; what links to the installed library
# decides for itself.
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX)  # lets CMAKE_POSITION_INDEPENDENT_CODE reach the linker

if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND UNIX AND NOT APPLE AND NOT LAMBENT_SANITIZE)
  set(optimised $<NOT:$<CONFIG:Debug>>)
  add_compile_options(
    "$<${optimised}:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2;-fstack-protector-strong>")
  add_link_options("$<${optimised}:LINKER:-z,relro;LINKER:-z,now>")
endif()
