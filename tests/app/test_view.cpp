// The interface driven off-screen by recorded input: the state of the engine afterwards, and what
// was drawn.
#include <fmt/format.h>

#include <random>
#include <utility>

#include "engine/core/text.h"
#include "render/gl/image.h"
#include "tests/app/visit.h"
#include "tests/environment.h"
#include "tests/results.h"

using gridshell::words_in;

namespace {

/// Checks that a key has the same value in both, to that fraction of it.
void check_same(const json& a, const json& b, const char* key, double fraction = 1e-9) {
  INFO(key);
  CHECK(number(a, key) == Approx(number(b, key)).epsilon(fraction));
}

/// Runs the preset that the window saved, checks that its energy is the reported one, and returns
/// the summary of the run.
json run_of_kept(const TemporaryFolder& folder, const json& reported) {
  const Ended ran = good("run kept/small_1.toml -o ran", folder);
  json summary = json::parse(text_of(folder / "ran/summary.json"));
  check_same(summary, reported, "energy_bend_mJ");
  return summary;
}

}  // namespace

TEST_CASE("a slider dragged in the window moves the boundary, in one step that can be undone",
          "[standard]") {
  const TemporaryFolder folder;
  const std::string moved = drag({"@R_a 0.5 0.5", "@R_a 0.6 0.5", "@R_a 0.7 0.5"});
  const json there = played(folder, moved, {"--shot", "there.png"});
  CHECK(there["undo_steps"] == 1);
  CHECK(number(there, "boundary_radius_mm") > 55);
  CHECK(there["negative_pivots"] == 0);
  CHECK(there["error_estimate_mm"].is_number());
  CHECK(gridshell::render::read_png(folder / "there.png")->width == 1280);
  // the same input gives the same state
  CHECK(played(folder, moved) == there);
  const json back = played(folder, moved + "down Ctrl\ndown Z\nup Z\nup Ctrl\n");
  CHECK(back["redo_steps"] == 1);
  CHECK(number(back, "boundary_radius_mm") == Approx(54));
}

TEST_CASE(
    "a joint dragged by the mouse is pushed and prescribed, and saved it is a preset that runs") {
  const TemporaryFolder folder;
  const json pushed = played(
      folder, drag({"@joint:0,0 0 0", "@joint:0,0 0 10", "@joint:0,0 0 8"}) + "do save_preset\n",
      {"-o", "kept"});
  CHECK(pushed["held"] == 1);
  CHECK(number(pushed, "force_N") > 0);
  CHECK(number(pushed, "depth_mm") > 1);
  check_same(run_of_kept(folder, pushed), pushed, "height_mm");
}

TEST_CASE("a number that is typed is meant when it is entered, not digit by digit") {
  const TemporaryFolder folder;
  const std::string typing = typed("@R_a", "5") + "type 6\n";
  const json before = played(folder, typing);
  CHECK(number(before, "boundary_radius_mm") == Approx(54));
  CHECK(before["undo_steps"] == 0);
  const json after = played(folder, typing + enter);
  CHECK(number(after, "boundary_radius_mm") == Approx(56));
  CHECK(after["undo_steps"] == 1);
}

TEST_CASE("a number that is refused says why, and is no step") {
  const TemporaryFolder folder;
  const json refused = played(folder, "do numbers\n" + typed("@rod.diameter_mm", "99") + enter);
  CHECK_THAT(message_of(refused), Contains("neighbouring rods would touch"));
  CHECK(refused["undo_steps"] == 0);
  CHECK(refused["error_estimate_mm"].is_number());
}

TEST_CASE("a joint is pushed where rods twist, too") {
  const TemporaryFolder folder;
  std::string twisting = shell;
  twisting.insert(twisting.find("[accuracy]\n") + 11, "model = \"twist\"\n");
  twisting += "[rod]\nshear_GPa = 30\n";
  const json pushed = played(folder, drag({"@joint:0,0 0 0", "@joint:0,0 0 6"}), {}, twisting);
  CHECK(pushed["held"] == 1);
  CHECK(number(pushed, "depth_mm") > 0.5);
}

TEST_CASE("keys do nothing to a shell that is hidden") {
  const TemporaryFolder folder;
  const json still = played(folder, "do help\ndown J\nup J\ndown G\nup G\n");
  CHECK(still["undo_steps"] == 0);
  CHECK(still["gravity"] == false);
}

TEST_CASE("an edge point dragged by the mouse, a key and a menu's action do what they say",
          "[standard]") {
  const TemporaryFolder folder;
  const json dragged =
      played(folder, "do view_top\n" + drag({"@edge:3 0 0", "@edge:3 8 6", "@edge:3 5 4"}));
  CHECK(dragged["undo_steps"] == 1);
  CHECK(dragged["held"] == 0);
  // the saved preset has these steps, and a run of it repeats them
  const json saved =
      played(folder,
             "do view_top\n" + drag({"@edge:3 0 0", "@edge:3 8 6"}) + "do jitter\ndo save_preset\n",
             {"-o", "kept"});
  good("run kept/small_1.toml -o ran", folder);
  const json summary = json::parse(text_of(folder / "ran/summary.json"));
  CHECK(summary["steps"].size() >= 2);
  CHECK(std::abs(number(summary, "energy_bend_mJ") - number(saved, "energy_bend_mJ")) <
        number(summary, "energies_error_mJ"));
  const json heavy = played(folder, "down G\nup G\n");
  CHECK(heavy["gravity"] == true);
  CHECK(heavy["undo_steps"] == 1);
  CHECK(message_of(heavy) == "[rod] density_kg_m3 = 6450 was assumed, that of nitinol");
}

TEST_CASE("rods without a density, of no known material, get no weight") {
  const TemporaryFolder folder;
  const json refused = played(folder, "do gravity\n", {}, shell + "[rod]\nyoung_GPa = 11\n");
  CHECK(refused["gravity"] == false);
  CHECK_THAT(message_of(refused), Contains("[rod] density_kg_m3"));
}

TEST_CASE("the input of no window is not recorded") {
  const TemporaryFolder folder;
  REQUIRE(write_file(folder / "small.toml", shell));
  REQUIRE(write_file(folder / "visit.txt", "do undo\n"));
  for (const std::string more : {"--play visit.txt", "--bench 0.1", "--picture shell.png"})
    check_refused(("view small.toml --record record.txt " + more).c_str(), folder,
                  Contains("--record"));
  CHECK_FALSE(fs::exists(folder / "record.txt"));
}

TEST_CASE("what cannot be done is said in the window, and by the recording's line") {
  const TemporaryFolder folder;
  CHECK(played(folder, "do undo\ndo undo\n")["message"] == "there is nothing to undo");
  const json stable = played(folder, "down Comma\nup Comma\n");
  CHECK(stable["message"] == "the shell is stable");
  CHECK(stable["undo_steps"] == 0);
  CHECK_THAT(played(folder, "open nothing_of_the_kind\n")["message"].get<std::string>(),
             Contains("nothing_of_the_kind"));
  const auto refused = [&](const std::string& input) {
    REQUIRE(write_file(folder / "visit.txt", input));
    return gridshell_program("view small.toml --play visit.txt", folder);
  };
  CHECK(refused("mouse @nothing 0 0\n").code == 2);
  CHECK(refused("do nothing\n").code == 2);
  CHECK_THAT(refused("mouse 1 2\npress thumb\n").err, Contains("visit.txt:2:"));
}

TEST_CASE("camera, colours and panels come back on the next visit, where they are kept") {
  const TemporaryFolder folder;
  played(folder, "do view_top\ndo dark\ndo colour_energy\n", {"--workspace", "kept/desk.json"});
  const auto kept = [&] { return json::parse(text_of(folder / "kept/desk.json")); };
  const json first = kept();
  CHECK(first["camera"]["elevation_deg"] == 90);
  CHECK(first["shown"]["dark"] == true);
  CHECK(first["colour"]["by"] == "energy");
  played(folder, "wait 0.1\n", {"--workspace", "kept/desk.json"});
  CHECK(kept() == first);
  played(folder, "wait 0.1\n");
  CHECK(kept() == first);
}

TEST_CASE("every panel, light and dark, at twice the density, and in a small window") {
  const TemporaryFolder folder;
  for (const auto& [size, width] : {std::pair("2560 1440 2", 2560), {"640 400 1", 640}}) {
    const std::string panels = "\ndo numbers\ndo dark\ndo jitter\ndo help\n";
    played(folder, std::string("size ") + size + panels, {"--shot", "all.png"});
    CHECK(gridshell::render::read_png(folder / "all.png")->width == width);
  }
}

TEST_CASE(
    "a shell is designed in the window, kept and saved with its tables, and runs to the same state",
    "[standard]") {
  const std::string cap =
      "title = \"cap\"\n[footprint]\nkind = \"net\"\nplacement = \"on_axis\"\n"
      "[net]\nkind = \"sphere\"\nradius_mm = 80.0\ncut_height = 0.5\n"
      "[actuation]\nstart = \"net\"\n[inverse]\nvary = [\"pins\"]\n";
  const TemporaryFolder folder;
  // the panel appears with the preset; diameters are varied, too
  const std::string design =
      click("@vary_diameters 0.05 0.5") + "down Ctrl\ndown D\nup D\nup Ctrl\n";
  const json begin = played(folder, "wait 0.1\n", {}, cap);
  const json designed = played(folder, design, {"--shot", "designed.png"}, cap);
  INFO(designed.dump());
  const json& course = designed["design"];
  CHECK(course["steps"].get<int>() > 2);
  CHECK(course["kept"] == false);
  CHECK(number(course, "max_mm") < 0.5 * number(course, "max_before_mm"));
  CHECK(designed["undo_steps"] == 1);
  // the same input gives the same state
  CHECK(played(folder, design, {}, cap) == designed);
  const json kept =
      played(folder, design + "do design_keep\ndo save_preset\n", {"-o", "kept"}, cap);
  CHECK(kept["design"]["kept"] == true);
  CHECK(fs::exists(folder / "kept/small_1_ends.csv"));
  CHECK(fs::exists(folder / "kept/small_1_rods.csv"));
  good("run kept/small_1.toml -o ran", folder);
  const json summary = json::parse(text_of(folder / "ran/summary.json"));
  for (const char* key : {"energy_bend_mJ", "height_mm"}) check_same(summary, kept, key, 1e-7);
  const json back = played(folder, design + "do design_put_back\n", {}, cap);
  CHECK_FALSE(back.contains("design"));
  for (const char* key : {"energy_bend_mJ", "height_mm", "residual_N", "undo_steps"})
    CHECK(back[key] == begin[key]);
  const json refused = played(folder, "do design\ndo design_start\n", {"--shot", "refused.png"});
  CHECK_THAT(message_of(refused), Contains("not designed on a net"));
}

TEST_CASE("a monkey at mouse and keys breaks nothing, and all it did can be undone", "[standard]") {
  // more events by GRIDSHELL_TRIALS, others by GRIDSHELL_SEED
  std::mt19937 random{unsigned(number_from("GRIDSHELL_SEED", 7))};
  const auto draw = [&](unsigned below) { return unsigned(random()) % below; };
  const auto commands = words_in(
      "do step_back,do gravity,do rest,do release,do numbers,do view_iso,do undo,do redo,"
      "do soft_mode,do colour_energy,do range_run,do push_freely,do dark,do orthographic,"
      "wheel 1,wheel -1,do copy_camera,do save_preset,do jitter,do pick_preset,do design,"
      "do design_start,do design_put_back,do to_loss,do state_next,do turn_up,do move_left,"
      "do compare_now,do save_plots",
      ",");
  std::string input;
  bool down = false;
  for (int k = number_from("GRIDSHELL_TRIALS", 80); k > 0; --k) {
    const unsigned what = draw(8);
    if (what < 2)
      input += fmt::format("mouse {} {}\n", draw(1280), 30 + draw(650));
    else if (what < 4)
      // at the shell, a few pixels from a joint or an edge point
      input += fmt::format("mouse @{} {} {}\n",
                           draw(2) == 0 ? fmt::format("joint:{},{}", int(draw(5)) - 2, 0)
                                        : fmt::format("edge:{}", draw(12)),
                           int(draw(30)) - 15, int(draw(30)) - 15);
    else if (what < 6)
      input += (std::exchange(down, !down) ? "release left\n" : "press left\n");
    else
      input += std::string(commands[draw(unsigned(commands.size()))]) + "\n";
  }
  if (down) input += "release left\n";
  const TemporaryFolder folder;
  const json begin = played(folder, "wait 0.1\n");
  const json end = played(folder, input + "do undo_all\n", {"-o", "kept"});
  for (const char* key :
       {"energy_bend_mJ", "boundary_radius_mm", "height_mm", "residual_N", "held"})
    CHECK(end[key] == begin[key]);
  CHECK(end["undo_steps"] == 0);
  const json other = played(folder, input + "open small.toml\n", {"-o", "kept"});
  CHECK(other["negative_pivots"] == 0);
  CHECK(number(other, "boundary_radius_mm") == Approx(54));
}

TEST_CASE("a shell is saved under a name, exported, and compared with a run", "[standard]") {
  const TemporaryFolder folder;
  REQUIRE(write_file(folder / "small.toml", shell));
  fs::create_directory(folder / "scanned");
  good("run small.toml -o ran", folder);
  // types a path into the prompt for a file and enters it
  const auto entered = [](const std::string& path) {
    return "wait 0.1\n" + click("@file_path 0.5 0.5") + "down Ctrl\ndown A\nup A\nup Ctrl\ntype " +
           path + "\n" + enter;
  };
  const std::string push = drag({"@joint:0,0 0 0", "@joint:0,0 0 8"});
  const json reported =
      played(folder, push + "do save_as\n" + entered("deep/mine") + "do export\n" +
                         entered("deep/mine.obj") + "do compare\n" + entered("ran"));
  const std::string said = reported["message"];
  CHECK_THAT(said, Catch::StartsWith("compared with ran: largest distance") &&
                       Contains("at joint (0, 0)"));
  played(folder, "do export\n" + entered("deep/all.xdmf"));
  CHECK_THAT(text_of(folder / "deep/all.xdmf"), Contains("all_run/trajectory.h5:/nodes"));
  CHECK(fs::exists(folder / "deep/all_run/trajectory.h5"));
  CHECK_THAT(message_of(played(folder, "do export\n" + entered("deep/all.xyz"))),
             Contains("expected one of .csv .dxf .glb .html .obj .pvd .vtp .xdmf .svg .pdf"));
  // a scan's joints, as `scan` writes them
  REQUIRE(write_file(folder / "scanned/scan.csv",
                     "i,j,x_mm,y_mm,z_mm,distance_mm,distance_radii\n0,0,0,0,99,,\n1,0,,,,,\n"));
  CHECK_THAT(played(folder, "do compare\n" + entered("scanned"))["message"].get<std::string>(),
             Contains("compared with scanned: largest distance") && Contains("joint (0, 0)"));
  // the OBJ and the preset are of the pushed shell
  CHECK(text_of(folder / "deep/mine.obj").find("\nv ") != std::string::npos);
  good("run deep/mine.toml -o again", folder);
  check_same(json::parse(text_of(folder / "again/summary.json")), reported, "height_mm");
  // an existing file is replaced only after a second request
  const json requested = played(folder, "do save_as\n" + entered("deep/mine"));
  CHECK(requested["message"] == "it is there already: once more replaces it");
  // a name that no file system accepts is refused in a sentence, with and without a folder
  for (const std::string& name : {std::string(300, 'x'), "deep/" + std::string(300, 'x')})
    CHECK_THAT(played(folder, "do save_as\n" + entered(name))["message"].get<std::string>(),
               Contains("File name too long"));
  CHECK_THAT(message_of(played(folder, "do compare\n" + entered("deep/mine.toml"))),
             Contains("deep"));
}

TEST_CASE("a step of the strip along the bottom is gone back to, and on to") {
  const TemporaryFolder folder;
  const std::string steps = drag({"@joint:0,0 0 0", "@joint:0,0 0 6"}) +
                            drag({"@R_a 0.5 0.5", "@R_a 0.6 0.5"}),
                    first = click("@step_0 0.5 0.5");
  const json back = played(folder, steps + first);
  CHECK((back["undo_steps"] == 0 && back["redo_steps"] == 2 && back["held"] == 0));
  const json on = played(folder, steps + first + click("@step_1 0.5 0.5"));
  CHECK((on["undo_steps"] == 1 && on["redo_steps"] == 1 && on["held"] == 1));
}

TEST_CASE("a click on a step with an event that is in sight shows the state before it") {
  const TemporaryFolder folder;
  const std::string lose = "open s1_actuation\n" + drag({"@R_a 0.5 0.5", "@R_a 0.941 0.5"});
  const json lost = played(folder, lose);
  CHECK(lost["negative_pivots"].get<int>() > 0);
  const json before = played(folder, lose + click("@step_1 0.5 0.5"));
  CHECK((before["negative_pivots"] == 0 && before["redo_steps"] == 1));
  // the key B goes to the loss of stability from any state
  const json found = played(folder, "open s1_actuation\ndown B\nup B\n");
  CHECK(found["negative_pivots"].get<int>() > 0);
}

TEST_CASE("the manual is shown in a browser, and where there is none it is said where it lies") {
  const TemporaryFolder folder;
  const auto shown = [&](const std::string& script) {
    REQUIRE(write_file(folder / "bin/xdg-open", "#!/bin/sh\n" + script + "\n"));
    fs::permissions(folder / "bin/xdg-open", fs::perms::owner_all);
    const Environment path("PATH", (folder / "bin").string() + ":" + std::getenv("PATH"));
    return message_of(played(folder, "do manual\n"));
  };
  fs::create_directory(folder / "bin");
  CHECK_THAT(shown("cp \"$1\" page.html"), Contains("shown in the browser"));
  const std::string page = text_of(folder / "page.html");
  for (const char* part : {"<h2>THE WINDOW</h2>", "<h3>gridshell movie", "<b>Undo everything</b>",
                           "<b>radius_mm</b> (mm)"})
    CHECK_THAT(page, Contains(part));
  CHECK_THAT(shown("exit 3"), Contains("no browser can be opened: the manual is /"));
}

TEST_CASE("a joint that was clicked is pushed to a depth that is typed") {
  const TemporaryFolder folder;
  const json pushed =
      played(folder, click("@joint:0,0 0 0") + "wait 0.1\n" + typed("@push_depth", "4") + enter);
  CHECK(pushed["held"] == 1);
  CHECK(number(pushed, "depth_mm") == Approx(4).epsilon(1e-6));
}

TEST_CASE("a number is found by a word and goes back to its default") {
  const TemporaryFolder folder;
  const json found = played(
      folder, "do find_number\nwait 0.2\ntype young\n" + typed("@rod.young_GPa", "40") + enter);
  CHECK(found["undo_steps"] == 1);
  const json back = played(folder, "do numbers\n" + typed("@rod.young_GPa", "40") + enter +
                                       click("@default_rod.young_GPa 0.5 0.5"));
  CHECK(back["undo_steps"] == 2);
  CHECK(number(back, "energy_bend_mJ") > 1.5 * number(found, "energy_bend_mJ"));
}

TEST_CASE("a movie of what was done is made in the background, and a picture of any size kept") {
  const TemporaryFolder folder;
  const json reported = played(
      folder, drag({"@joint:0,0 0 0", "@joint:0,0 0 10"}) + "do save_picture\ndo save_movie\n",
      {"-o", "kept", "--size", "320x180", "--quality", "draft"});
  CHECK_THAT(message_of(reported), Catch::EndsWith("/kept/small_1"));
  const auto picture =
      gridshell::value_of(gridshell::render::read_png(folder / "kept/small_1.png"));
  CHECK((picture.width == 320 && picture.height == 180));
  CHECK(fs::exists(folder / "kept/small_1/frames/frame_00001.png"));
  const json made = json::parse(text_of(folder / "kept/small_1/summary.json"));
  check_same(made, reported, "energy_bend_mJ");
  // the preset of the movie is a valid preset of its own
  CHECK(gridshell_program("check kept/small_1.toml", folder).code == 0);
}

TEST_CASE("the shell alone is drawn off-screen, with its legend or bare") {
  const TemporaryFolder folder;
  REQUIRE(write_file(folder / "small.toml", shell));
  const auto drawn = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"view", "small.toml", "--picture", "shell.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gridshell_program(arguments, folder).code;
  };
  const auto ink = [&] {
    const auto picture = gridshell::render::read_png(folder / "shell.png").value();
    CHECK((picture.width == 400 && picture.height == 300));
    // right of the shell, at the legend
    int dark = 0;
    for (int y = 0; y < 150; ++y)
      for (int x = 330; x < 400; ++x) dark += picture.pixel(x, y)[1] < 128;
    return dark;
  };
  REQUIRE(drawn({"--size", "400x300"}) == 0);
  const int with_legend = ink();
  REQUIRE(drawn({"--size", "400x300", "--bare"}) == 0);
  CHECK(with_legend > ink() + 100);
  CHECK(drawn({"--size", "4x3"}) == 2);
  CHECK(drawn({"--size", "large"}) == 2);
}

TEST_CASE("without a display the window says what to do instead") {
  const TemporaryFolder folder;
  // no display has this name
  const Environment display("DISPLAY", ":nowhere");
  const Ended ended = gridshell_program("view", folder);
  CHECK(ended.code == 1);
  CHECK_THAT(ended.err, Contains("--play"));
  CHECK(std::count(ended.err.begin(), ended.err.end(), '\n') == 1);
}

TEST_CASE("a bench drags by itself and prints its four figures") {
  const TemporaryFolder folder;
  REQUIRE(write_file(folder / "small.toml", shell));
  const Ended ended = good("view small.toml --bench 0.5", folder);
  const json line = json::parse(ended.out);
  CHECK(number(line, "interface_fps") > 0);
  CHECK(number(line, "equilibria_per_s") > 0);
  CHECK(line.contains("worst_frame_ms"));
  CHECK(line.contains("cancel_ms"));
}
