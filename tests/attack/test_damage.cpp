// Damaged run folders, as somebody else may have made them, through `render` and `compare`: these
// must end in time, write only the requested files and use little memory.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/core/file_io.h"
#include "tests/app/unfinished_run.h"
#include "tests/attack/answers.h"
#include "tests/attack/trials.h"
#include "tests/small_preset.h"

namespace fs = std::filesystem;
using gridshell::read_file;
using gridshell::write_file;
using Json = nlohmann::json;

namespace {

const std::string small =
    small_preset({.rods = 2, .radius_mm = 25, .actuated_mm = 22, .width = 48, .height = 32});

// adds the checksum as trajectory_file.cpp does, so that the reader gets past it to the damage
std::string with_checksum(const std::string& hdf5) {
  const auto sum = gridshell::Checksum::of(hdf5, gridshell::ChecksumKind::crc32);
  auto checksum =
      fmt::format("gridshell trajectory 1\n{} bytes, CRC-32 {:016x}\n", hdf5.size(), sum);
  checksum.resize(512, '\0');
  return checksum + hdf5;
}

// symlink_status, because a link that leads in a circle has no status
bool is_plain(const fs::path& file) {
  return fs::symlink_status(file).type() == fs::file_type::regular;
}

fs::path some_file(const fs::path& run, Draw& draw) {
  const auto files = files_under(run, "");
  std::vector<fs::path> plain;
  for (const auto& file : files)
    if (is_plain(file)) plain.push_back(file);
  // an earlier damage may have left no regular file
  if (plain.empty()) return run / "preset.toml";
  // half of the attacks are on the files that the program reads
  for (const char* name : {"trajectory.h5", "summary.json", "preset.toml", "frames.journal"})
    if (draw.one_in(6) && is_plain(run / name)) return run / name;
  return draw.of(plain);
}

void change_bytes(const fs::path& file, Draw& draw) {
  auto bytes = read_file(file).value();
  // an earlier damage may have left less than a checksum
  const bool add_checksum =
      file.filename() == "trajectory.h5" && bytes.size() >= 512 && !draw.one_in(4);
  if (add_checksum) bytes = bytes.substr(512);
  for (std::size_t k = std::size_t(1) << draw.below(6); k > 0 && !bytes.empty(); --k) {
    char& at = bytes[draw.below(bytes.size())];
    at = draw.one_in(3) ? char(at ^ (1 << draw.below(8))) : draw.one_in(2) ? '\xff' : draw.byte();
  }
  if (draw.one_in(8)) bytes.resize(draw.below(bytes.size() + 1));
  REQUIRE(write_file(file, add_checksum ? with_checksum(bytes) : bytes));
}

void replace_file(const fs::path& file, const fs::path& run, Draw& draw) {
  const auto other = some_file(run, draw);
  const auto bytes = read_file(other).value();
  fs::remove(file);
  draw.one_of({[] {}, [&] { fs::create_directory(file); },
               [&] { REQUIRE(mkfifo(file.c_str(), 0600) == 0); },
               [&] { fs::create_symlink("/dev/zero", file); },
               [&] { fs::create_symlink("/etc/passwd", file); },
               [&] { fs::create_symlink(file.filename(), file); },
               [&] { REQUIRE(write_file(file, "")); }, [&] { REQUIRE(write_file(file, bytes)); }});
}

Json hostile_json(Draw& draw) {
  static const auto values =
      listed(R"(null | -1 | 0 | 1e308 | 1e999 | 18446744073709551615 | true | "" | "x" | ".." | )"
             R"("../victim" | "/tmp/gridshell-victim" | "a/b" | "frames" | [] | {} | [[[[1]]]] | )"
             R"("\u0000" | "\u001b[2J" | "movie" | "figure")");
  if (draw.one_in(12)) return std::string(100000, 'x');
  return Json::parse(draw.of(values), nullptr, false);
}

void change_summary(const fs::path& run, Draw& draw) {
  const auto file = run / "summary.json";
  if (!is_plain(file)) return;
  auto json = Json::parse(read_file(file).value(), nullptr, false);
  if (!json.is_object()) return;
  const bool cases = json.contains("cases") && json["cases"].is_array() && !json["cases"].empty();
  if (cases && !draw.one_in(4)) {
    auto& one = json["cases"][draw.below(json["cases"].size())];
    if (one.is_object()) one[draw.one_in(2) ? "name" : "preset"] = hostile_json(draw);
  } else if (!json.empty()) {
    auto at = json.begin();
    std::advance(at, draw.below(json.size()));
    *at = hostile_json(draw);
  }
  if (draw.one_in(10)) json["cases"] = hostile_json(draw);
  const auto text = json.dump(1, ' ', false, Json::error_handler_t::replace);
  REQUIRE(write_file(file, text));
}

void damage(const fs::path& run, Draw& draw) {
  const fs::path file = some_file(run, draw);
  if (!is_plain(file)) return;
  const auto bytes = [&] { change_bytes(file, draw); };
  draw.one_of(
      {bytes, bytes, [&] { replace_file(file, run, draw); }, [&] { change_summary(run, draw); }});
}

class RunsToDamage {
 public:
  RunsToDamage() {
    REQUIRE(write_file(at / "small.toml", small));
    REQUIRE(
        write_file(at / "cases.toml", small + "[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n"));
    for (const char* name : {"small", "cases"})
      REQUIRE(run({"movie", std::string(name) + ".toml", "-o", name}).code == 0);
    cut_short(at / "small", at / "cut", 2);
  }
  Ended run(const std::vector<std::string>& arguments) const {
    return ended_within(Running(arguments, at), 20, SIGKILL);
  }

  TemporaryFolder folder;
  fs::path at = folder;
};

void check_answer(const Ended& ended, std::initializer_list<int> codes) {
  INFO(ended.code << ": " << ended.err.substr(0, 2000));
  CHECK(std::find(codes.begin(), codes.end(), ended.code) != codes.end());
  CHECK(ended.peak_MB < 400);
  if (ended.code == 1 || ended.code == 2) check_message(ended);
}

}  // namespace

TEST_CASE("damaged run folders are answered, and nothing else is touched", "[standard][damage]") {
  const RunsToDamage runs;
  const auto& at = runs.at;
  const auto before = contents(at);
  std::map<int, int> codes;
  for (int trial = 0; trial < trials(10); ++trial) {
    Draw draw(trial);
    INFO("trial " << trial);
    const auto source = draw.of(std::vector<std::string>{"small", "cases", "cut"});
    fs::copy(at / source, at / "r", fs::copy_options::recursive);
    for (std::size_t k = draw.one_in(4) ? 3 : 1; k > 0; --k) damage(at / "r", draw);
    const auto damaged = contents(at / "r");
    std::vector<std::string> arguments{"render", "r", "--quiet"};
    const bool in_place = draw.one_in(3);
    if (!in_place) arguments.insert(arguments.end(), {"-o", "o"});
    if (draw.one_in(4)) arguments.push_back("--unsealed");
    const auto ended = runs.run(arguments);
    check_answer(ended, {0, 1, 2});
    ++codes[ended.code];
    if (!in_place || ended.code != 0) CHECK(contents(at / "r") == damaged);
    const auto picture = files_under(at / "r", ".png");
    if (!picture.empty() && draw.one_in(2))
      check_answer(runs.run({"compare", draw.of(picture), "small/frames/frame_00001.png"}),
                   {0, 2, 3});
    fs::remove_all(at / "r");
    fs::remove_all(at / "o");
    for (const auto& name : runs.folder.entries())
      if (name.starts_with("o.partial-") || name.starts_with("r.partial-"))
        fs::remove_all(at / name);
    REQUIRE(contents(at) == before);
    REQUIRE_FALSE(fs::exists("/tmp/gridshell-victim"));
  }
  print_codes(codes, "render");
}
