# Writes a .cpp that contains page.html as text. Arguments: PAGE, OUTPUT.
file(READ ${PAGE} content)
file(WRITE ${OUTPUT} "// Generated from page.html.
#include \"engine/record/shape_export.h\"

namespace gridshell::exports {
const char* const page_template = R\"page(${content})page\";
}  // namespace gridshell::exports
")
