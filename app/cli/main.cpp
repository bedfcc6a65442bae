// The program `gridshell`.
#include "app/cli/commands.h"

int main(int argc, char** argv) { return gridshell::app::run_program(argc, argv); }
