// Which bits of a run are equal over what (engine/accuracy.md, "The same bits").
#include <gnu/libc-version.h>

#include "engine/record/trajectory_file.h"
#include "tests/app/bench.h"

namespace {

struct Scene {
  const char *kind, *preset;
};
// a preset of each kind, run on coarse meshes
constexpr Scene scenes[] = {{"circle", "s1_actuation"},    {"curve", "curve_ellipse"},
                            {"cap", "fig3_hemisphere"},    {"revolution", "net_barrel"},
                            {"assemblage", "fig5_peanut"}, {"push", "s3_pole_inward"},
                            {"twist", "model_clamped"},    {"loads", "model_loads"}};

fs::path run(const Scene& scene, const fs::path& at, const std::string& name,
             std::vector<std::string> more = {}, const char* program = GRIDSHELL_PROGRAM) {
  std::vector<std::string> arguments{"run",     scene.preset, "--frames",
                                     "3",       "--set",      "accuracy.edges_per_segment=4",
                                     "--quiet", "-o",         name};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto ended = Running(arguments, at, program).wait();
  INFO(scene.kind << ": " << ended.err);
  // a path that ends early (exit code 1) has frames up to its end
  REQUIRE(ended.code <= 1);
  return at / name;
}

// checksum of all numbers of all frames, from the trajectory
std::string hash_of(const fs::path& run) {
  const auto text = text_of(run / "trajectory.h5");
  const std::string before = "CRC-32 ";
  const auto at = text.find(before);
  REQUIRE(at < 200);
  return text.substr(at + before.size(), 16);
}

#ifdef GRIDSHELL_BASELINE_PROGRAM
constexpr bool has_clones = true;
constexpr const char* baseline = GRIDSHELL_BASELINE_PROGRAM;
bool runs_fast_clones() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2");
}
#else
constexpr bool has_clones = false;
constexpr const char* baseline = GRIDSHELL_PROGRAM;
bool runs_fast_clones() { return false; }
#endif

const fs::path table = fs::path(GRIDSHELL_SOURCE_DIR) / "tests/app/golden_hashes.txt";

// what the hashes depend on in addition to the sources
std::string made_with() {
  return fmt::format("# {}, glibc {}\n", GRIDSHELL_BUILT_WITH, gnu_get_libc_version());
}

// results of the last frame of a run
struct Figures {
  double height_mm = 0, energy_mJ = 0;

  explicit Figures(const fs::path& run) {
    const auto trajectory = gridshell::record::read_trajectory(run / "trajectory.h5");
    REQUIRE(trajectory);
    REQUIRE_FALSE(trajectory->frames.empty());
    const auto& last = trajectory->frames.back();
    height_mm = last.nodes.row(2).maxCoeff();
    energy_mJ = last.energies.total();
  }
};

// compares with the line of `kind` in the table to 1e-8: other compilers and libraries round
// differently, so their hashes are not comparable
void check_near(const Figures& now, const std::string& kept, const std::string& kind) {
  const std::string before = "\n" + kind + " height_mm energy_mJ ";
  const auto at = kept.find(before);
  REQUIRE(at != kept.npos);
  double height_mm = 0, energy_mJ = 0;
  std::istringstream(kept.substr(at + before.size())) >> height_mm >> energy_mJ;
  CHECK(now.height_mm == Approx(height_mm).epsilon(1e-8));
  CHECK(now.energy_mJ == Approx(energy_mJ).epsilon(1e-8));
}

// compares two runs: nodes to 1e-9 of the length scale, energies to 1e-9 of themselves
void check_near(const fs::path& a, const fs::path& b) {
  const auto one = gridshell::record::read_trajectory(a / "trajectory.h5"),
             two = gridshell::record::read_trajectory(b / "trajectory.h5");
  REQUIRE(one);
  REQUIRE(two);
  REQUIRE(one->frames.size() == two->frames.size());
  for (std::size_t k = 0; k < one->frames.size(); ++k) {
    const gridshell::record::Frame &f = one->frames[k], &g = two->frames[k];
    CHECK((f.nodes - g.nodes).cwiseAbs().maxCoeff() < 1e-9 * one->layout.length_scale_mm);
    CHECK(f.energies.total() == Approx(g.energies.total()).epsilon(1e-9).margin(1e-9));
    CHECK(f.negative_pivots == g.negative_pivots);
  }
}

}  // namespace

TEST_CASE("pictures have the same bits in every context", "[standard]") {
  const TemporaryFolder folder;
  const auto draw = [&](const std::string& context) {
    return gridshell_program({"movie", "s1_actuation", "--frames", "2", "--size", "160x90",
                              "--quiet", "--set", "accuracy.edges_per_segment=4", "--set",
                              "movie.title_s=0", "--context", context, "-o", context},
                             folder);
  };
  REQUIRE(draw("osmesa").code == 0);
  if (const auto other = draw("egl"); other.code != 0) {
    WARN("no EGL here: " << other.err);
    return;
  }
  const auto pictures = files_under(folder / "osmesa", ".png");
  REQUIRE(pictures.size() == 2);
  for (const auto& picture : pictures) {
    INFO(picture);
    const auto other = folder / "egl/frames" / picture.filename();
    CHECK(text_of(picture) == text_of(other));
  }
  CHECK(hash_of(folder / "osmesa") == hash_of(folder / "egl"));
}

TEST_CASE("golden hashes of all kinds of runs, the same on any number of threads", "[standard]") {
  const TemporaryFolder at;
  // on every processor the C library uses its functions for plain x86-64
  const Environment library("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-AVX512F,-FMA,-FMA4");
  const bool again = std::getenv("GRIDSHELL_GOLDEN");
  const auto kept = text_of(table);
  std::string now, figures;
  for (const Scene& scene : scenes) {
    INFO(scene.kind);
    const auto fast = run(scene, at, "fast"), plain = run(scene, at, "plain", {}, baseline);
    const std::string first = hash_of(fast), kind = scene.kind;
    for (const char* threads : {"1", "3"})
      CHECK(hash_of(run(scene, at, "again", {"--threads", threads})) == first);
    const Figures reported(fast);
    figures += fmt::format("{} height_mm energy_mJ {:.12g} {:.12g}\n", kind, reported.height_mm,
                           reported.energy_mJ);
    if (!again) check_near(reported, kept, kind);
    now += kind + " x86-64 " + hash_of(plain) + "\n";
    if (!has_clones || !runs_fast_clones()) continue;
    now += kind + " x86-64-v3 " + first + "\n";
    // equal hashes would mean that the same clone ran twice
    CHECK(first != hash_of(plain));
    check_near(fast, plain);
  }
  if (again) {
    REQUIRE(has_clones);
    REQUIRE(runs_fast_clones());
    REQUIRE(write_file(table, made_with() + now + figures));
    return;
  }
  if (!has_clones || !kept.starts_with(made_with())) {
    WARN("compared to 1e-8, not to the bit: the table was made with "
         << kept.substr(0, kept.find('\n')));
    return;
  }
  INFO("If the change is meant: GRIDSHELL_GOLDEN=1 build/test_app \"golden hashes*\" writes\n"
       << now);
  std::istringstream lines(now);
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    const bool known = kept.find(line + "\n") != std::string::npos;
    CHECK(known);
  }
}
