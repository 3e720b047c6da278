# cmake -D OUTPUT=… -D SHADERS=a.glsl|b.glsl -P EmbedShaders.cmake: shader texts → one C++ source, so
# that an installed library looks for no file.
set(text "// Made from shaders/ by EmbedShaders.cmake.\n")
string(APPEND text "#include \"lambent/render/shader_sources.h\"\n\nnamespace lambent::render {\n\n")
string(APPEND text "std::string_view shaderSource(std::string_view name) {\n")
string(REPLACE "|" ";" SHADERS "${SHADERS}")
foreach(shader IN LISTS SHADERS)
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} source)
  string(APPEND text "  if (name == \"${name}\")\n    return R\"GLSL(${source})GLSL\";\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace lambent::render\n")
file(WRITE ${OUTPUT} "${text}")
