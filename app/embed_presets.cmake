# Writes a .cpp that holds every presets/*.toml as text, so that the program stands alone.
# Arguments: PRESETS (list of files), OUTPUT.
set(text "// Generated from presets/*.toml.\n#include \"app/preset_library.h\"\n\n")
string(APPEND text "namespace gridshell::app {\n\n")
string(APPEND text "const std::vector<EmbeddedPreset>& embedded_presets() {\n")
string(APPEND text "  static const std::vector<EmbeddedPreset> presets = {\n")
foreach(file IN LISTS PRESETS)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} content)
  string(APPEND text "    {\"${name}\", R\"preset(${content})preset\"},\n")
endforeach()
string(APPEND text "  };\n  return presets;\n}\n\n}  // namespace gridshell::app\n")
file(WRITE ${OUTPUT} "${text}")
