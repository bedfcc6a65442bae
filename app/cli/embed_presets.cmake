# Writes a .cpp that contains every presets/*.toml and the files that they name as text, so that the program
# needs none of them. Arguments: PRESETS and FILES (lists of files), OUTPUT.
set(text "// Generated from presets/*.toml.\n#include \"app/cli/preset_library.h\"\n\n")
string(APPEND text "namespace gridshell::app {\n\n")

# embed(FUNCTION TYPE NAME_PART FILES...): the function that returns the files by their names
function(embed function type part)
  string(APPEND text "const ${type}& ${function}() {\n  static const ${type} all = {\n")
  foreach(file IN LISTS ARGN)
    get_filename_component(name ${file} ${part})
    file(READ ${file} content)
    string(APPEND text "    {\"${name}\", R\"preset(${content})preset\"},\n")
  endforeach()
  string(APPEND text "  };\n  return all;\n}\n\n")
  set(text "${text}" PARENT_SCOPE)
endfunction()

embed(embedded_presets "std::vector<EmbeddedPreset>" NAME_WE ${PRESETS})
embed(embedded_files "std::map<std::string, std::string>" NAME ${FILES})
string(APPEND text "}  // namespace gridshell::app\n")
file(WRITE ${OUTPUT} "${text}")
