// Pages of panels: which presets have the cases that a page shows.
#include "app/cli/paper_page.h"

#include "app/cli/preset_library.h"
#include "tests/app/bench.h"
#include "tests/results.h"

using namespace gridshell;

TEST_CASE("a page that shows other cases than the preset has is refused before anything runs") {
  const TemporaryFolder at;
  const auto refused = [&](const std::string& preset, const std::string& kind,
                           const std::string& expected) {
    INFO(preset << " " << kind);
    const std::string key = "page.kind=" + kind;
    for (const char* command : {"figure", "check"})
      check_refused({command, preset, "--set", key}, at,
                    Contains("[page] kind: got \"" + kind + "\", expected " + expected));
  };
  // no net, no case without a push, no case with one
  refused("s1_actuation", "fig3", "a case without [indentation], and all such cases on nets");
  refused("s3_pole_inward", "fig3", "a case without [indentation]");
  refused("s1_actuation", "fig4", "cases with [indentation] and cases without");
  refused("s3_pole_inward", "fig4", "cases with [indentation] and cases without");
  refused("net_barrel", "fig4", "cases with [indentation] and cases without");
  refused("s3_pole_inward", "fig5", "a case without [indentation]");
  refused("s1_actuation", "fig2", "a search for states");
  CHECK(fs::is_empty(at.path()));
}

TEST_CASE("the pages that come with the program have their cases") {
  for (const app::EmbeddedPreset& one : app::embedded_presets()) {
    INFO(one.name);
    CHECK(app::check_page(app::runs_of(value_of(app::load_preset(one.name, {})))));
  }
}

TEST_CASE("panels of a page are lettered past Z") {
  CHECK(app::panel_letter(0) == "A");
  CHECK(app::panel_letter(25) == "Z");
  CHECK(app::panel_letter(26) == "AA");
  CHECK(app::panel_letter(27 * 26) == "AAA");
}
