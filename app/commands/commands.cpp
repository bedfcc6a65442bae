#include "app/commands/commands.h"

namespace gridshell::app {

void add_commands(CLI::App& program, Action& action) {
  add_movie(program, action);
  add_figure(program, action);
  add_run(program, action);
  add_render(program, action);
  add_view(program, action);
  add_chart(program, action);
  add_sweep(program, action);
  add_design(program, action);
  add_export(program, action);
  add_scan(program, action);
  add_check(program, action);
  add_compare(program, action);
  add_list(program, action);
}

}  // namespace gridshell::app
