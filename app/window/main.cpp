// The program `gridshell_window`: all commands, and the window, which `gridshell` leaves to it.
#include "app/window/manual.h"
#include "app/window/view.h"

int main(int argc, char** argv) {
  using namespace gridshell;
  return app::run_program(argc, argv, {window::view, window::man_page});
}
