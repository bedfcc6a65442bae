// The panels by mouse and by keyboard alone.
#include "tests/app/visit.h"

TEST_CASE("a click on a number types it, and its digits never turn the view") {
  const TemporaryFolder folder;
  const json after = played(
      folder, click("@R_a_number 0.5 0.5") + "down 5\nup 5\ntype 5\ndown 6\nup 6\ntype 6\n" + enter,
      {"--shot", "typed.png"});
  CHECK(number(after, "boundary_radius_mm") == Approx(56));
  // digits over a control that is not typed into do nothing
  const std::string over = "mouse @R_a_number 0.5 0.5\nwait 1\n";
  played(folder, over, {"--shot", "before.png"});
  played(folder, over + "down 7\nup 7\nwait 1\n", {"--shot", "after.png"});
  CHECK(text_of(folder / "before.png") == text_of(folder / "after.png"));
}

TEST_CASE("the keyboard alone reaches numbers, and an entry of a menu changes the picture") {
  const TemporaryFolder folder;
  const auto press = [](const std::string& key) { return "down " + key + "\nup " + key + "\n"; };
  // the first Tab goes to the slider of the path, whose number is then typed
  const json moved = played(folder, press("Tab") + "type 0.5\n" + enter);
  CHECK(number(moved, "progress") == Approx(0.5));
  // Alt+H opens the menu Help, in which the arrow keys move
  const json menu = played(
      folder,
      "down Alt\n" + press("H") + "up Alt\n" + press("Down") + press("Down") + press("Space"),
      {"--shot", "menu.png"});
  const json none = played(folder, "", {"--shot", "none.png"});
  CHECK(text_of(folder / "menu.png") != text_of(folder / "none.png"));
  // letters with Alt are no shortcuts
  CHECK(played(folder, "down Alt\n" + press("G") + "up Alt\n")["gravity"] == false);
}

TEST_CASE("a parameter that is called as the words that are looked for is listed first") {
  const TemporaryFolder folder;
  const json after = played(folder, "do find_number\nwait 0.1\ntype rods\nwait 0.1\n" +
                                        typed("@footprint.rods", "4") + enter);
  CHECK(after["undo_steps"] == 1);
  CHECK(number(after, "height_mm") > 5);
}

TEST_CASE("the search over the parameters finds a table by its name") {
  const TemporaryFolder folder;
  const json after = played(folder, "do find_number\nwait 0.1\ntype contact\nwait 0.1\n" +
                                        click("@table_contact 0.5 0.5"));
  CHECK(after["undo_steps"] == 0);
}

TEST_CASE("a number that may be none is typed, and its default is none again") {
  const TemporaryFolder folder;
  const std::string find = "do find_number\nwait 0.1\ntype joints diameter\nwait 0.1\n";
  const std::string wide = find + typed("@joints.diameter_mm", "7") + enter;
  const auto saved = [&](const std::string& input) {
    played(folder, input + "do save_preset\n", {"-o", "kept"});
    const std::string text = text_of(folder / "kept/small_1.toml");
    fs::remove(folder / "kept/small_1.toml");
    return text.find("diameter_mm = 7") != std::string::npos;
  };
  CHECK(saved(wide));
  CHECK_FALSE(saved(wide + click("@default_joints.diameter_mm 0.5 0.5")));
}

TEST_CASE("a shell of one's own is formed from the form") {
  const TemporaryFolder folder;
  const json formed =
      played(folder, "do new_shell\n" + typed("@new_rods", "6") + enter +
                         typed("@new_radius", "66") + enter + click("@new_form 0.5 0.5"));
  CHECK(formed["preset"] == "new_shell");
  CHECK(number(formed, "boundary_radius_mm") == Approx(0.8 * 66));
  // a circle without room is explained, and a click gives it room
  const json fitted = played(folder, "do new_shell\n" + typed("@new_rods", "8") + enter +
                                         typed("@new_radius", "50") + enter +
                                         click("@new_fit 0.5 0.5") + click("@new_form 0.5 0.5"));
  CHECK(number(fitted, "boundary_radius_mm") == Approx(0.8 * 86));
}

TEST_CASE("a material that is chosen gives its values to the rods") {
  const TemporaryFolder folder;
  const std::string press = "down Down\nup Down\n";
  played(folder,
         "do find_number\nwait 0.1\ntype material\nwait 0.1\n" + click("@rod.material 0.5 0.5") +
             "wait 0.1\n" + press + press + "down Space\nup Space\n" + "wait 0.1\ndo save_preset\n",
         {"-o", "kept"});
  const std::string text = text_of(folder / "kept/small_1.toml");
  CAPTURE(text);
  CHECK_THAT(text, Contains("material = \"gfrp\""));
  CHECK_THAT(text, Contains("young_GPa = 25.0"));
}

TEST_CASE("a window without room for the shell saves a picture, as small as pictures are") {
  const TemporaryFolder folder;
  const json after = played(folder, "size 320 240 4\ndo save_picture\n", {"-o", "kept"});
  INFO(message_of(after));
  CHECK(fs::exists(folder / "kept/small_1.png"));
}
