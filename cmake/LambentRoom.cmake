# lambent_room(<name> SOURCES … [PUBLIC …] [PRIVATE …] [TESTS …] [TEST_LIBS …])
#
# A room is one static library: folder = include path = namespace = target lambent::<name>.
# PUBLIC and PRIVATE name what it may include. tools/check_rooms.py holds the includes to
# that.
# TESTS become one executable, lambent_<name>_tests, whose cases ctest sees as <name>.<Suite>.<Case>.

if(LAMBENT_TESTS)
  enable_testing()
  include(GoogleTest)
  find_package(GTest REQUIRED)
endif()

add_library(lambent_warnings INTERFACE)
target_compile_options(lambent_warnings INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bug 105651: false alarms on "text" + std::string.
  target_compile_options(lambent_warnings INTERFACE -Wno-restrict)
endif()
if(LAMBENT_SANITIZE)
  add_compile_options(-fsanitize=${LAMBENT_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LAMBENT_SANITIZE})
  if(LAMBENT_SANITIZE MATCHES "undefined")
    # What address finds too, at a third of the compilation: null pointers, and objects that are
    # not of their class.
    add_compile_options(-fno-sanitize-recover=undefined -fno-sanitize=null,vptr)
  endif()
endif()

# Unity builds (CMAKE_UNITY_BUILD, as the release preset sets it) compile files together, which
# reads what they include once: a clean build takes half the time. What one file forgets to include
# or calls like another file's shows in the presets that compile file by file (dev, clang).
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

# The faster linker where it is there.
find_program(LAMBENT_LLD ld.lld)
if(LAMBENT_LLD AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  add_link_options(-fuse-ld=lld)
endif()

# The rooms whose code the fuzzer watches: those that read bytes which come from anywhere.
set(fuzzed_rooms file image scene_io asset light sky sources view)

set_property(GLOBAL PROPERTY LAMBENT_ROOMS "")

function(lambent_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE;TESTS;TEST_LIBS" ${ARGN})
  set(target lambent_${name})
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    set(scope PUBLIC)
    if(LAMBENT_FUZZ AND name IN_LIST fuzzed_rooms)
      target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    endif()
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:lambent_warnings> ${ROOM_PRIVATE})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(lambent::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${scope} ${ROOM_PUBLIC})
  set_property(GLOBAL APPEND PROPERTY LAMBENT_ROOMS ${target})
  if(LAMBENT_TESTS AND ROOM_TESTS)
    add_executable(${target}_tests ${ROOM_TESTS})
    target_link_libraries(${target}_tests PRIVATE lambent::${name} ${ROOM_TEST_LIBS}
      lambent_warnings GTest::gtest GTest::gtest_main)
    # What is tested is as optimised as it is delivered; what tests it is compiled in half the time.
    target_compile_options(${target}_tests PRIVATE $<$<CONFIG:Release>:-O1>)
    gtest_discover_tests(${target}_tests TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS ${name})
  endif()
endfunction()

# lambent_isa_kernels(<target> <file>): compiles one file three times, for the baseline, AVX2+FMA
# and AVX-512 instruction sets, each in its own namespace LAMBENT_ISA, so that one package runs at
# full speed on every machine. The file must not include Eigen or any header with inline functions
# of external linkage (they would be compiled for the wrong machine); see lambent/math/isa.h for
# the choice at run time.
function(lambent_isa_kernels target file)
  get_filename_component(stem ${file} NAME_WE)
  foreach(isa IN ITEMS baseline avx2 avx512)
    if(isa STREQUAL "baseline")
      set(flags "")
    elseif(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
      continue()
    elseif(isa STREQUAL "avx2")
      set(flags -march=x86-64-v3)
    else()
      set(flags -march=x86-64-v4 -mprefer-vector-width=512)
    endif()
    set(object ${target}_${stem}_${isa})
    add_library(${object} OBJECT ${file})
    target_include_directories(${object} PRIVATE ${PROJECT_SOURCE_DIR})
    target_compile_definitions(${object} PRIVATE LAMBENT_ISA=${isa})
    target_compile_options(${object} PRIVATE -O3 -ffp-contract=fast ${flags})
    # Under sanitizers the baseline is looked at (LAMBENT_ISA=baseline chooses it): the others are
    # the same text, and take minutes to compile where they are instrumented.
    if(LAMBENT_SANITIZE AND NOT isa STREQUAL "baseline")
      target_compile_options(${object} PRIVATE -fno-sanitize=all)
    elseif(LAMBENT_SANITIZE)
      target_compile_options(${object} PRIVATE -O1)
    endif()
    target_link_libraries(${object} PRIVATE lambent_warnings)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
  endforeach()
endfunction()
