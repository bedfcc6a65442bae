// The program `gridshell_window`: all commands, with `view` and `list --man`, which `gridshell`
// does not have itself.
#include "app/window/manual.h"
#include "app/window/view.h"

int main(int argc, char** argv) {
  using namespace gridshell;
  return app::run_program(argc, argv, {window::view, window::man_page});
}
