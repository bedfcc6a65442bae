// states.csv, states.json, transitions.csv and barriers.csv read back as they were written.
#include "engine/record/states.h"

#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;

namespace {

const record::StateName iv_1{1, record::StateClass::iv}, other_2{2, record::StateClass::other};

record::StateTables sample() {
  record::StateTables tables;
  record::StateRow row;
  row.state = 1;
  row.kind = record::StateClass::iv;
  row.group = "C4v";
  row.energies[Term::bend] = 39.91;
  row.inflections = "2 3 2 | 2 3 2";
  row.count = 6;
  row.lives_to = 0.0325;
  tables.rows = {row, row};
  tables.rows[1].state = 2;
  tables.rows[1].kind = record::StateClass::other;
  tables.search.mode = "random";
  tables.search.trials = 900;
  tables.search.ended_otherwise["did not come to rest"] = 3;
  tables.search.completeness = {2, 1, 1, 2.5, 2.1, 9.0};
  tables.transitions = {{iv_1, other_2, record::Disturbance::released, 1},
                        {iv_1, {}, record::Disturbance::pushed, 7}};
  tables.barriers = {{iv_1, other_2, 40.5, 0.59, 0.25, 1e-12}, {other_2, {}, 41.0}};
  tables.rows[1].barrier_mJ = 0.25;
  return tables;
}

}  // namespace

TEST_CASE("state tables: what is written is read back, what is unknown stays so") {
  const TemporaryFolder folder;
  const record::StateTables written = sample();
  REQUIRE(record::write_state_tables(folder, written));
  const auto read = value_of(record::read_state_tables(folder));
  CHECK(record::csv_table(read.rows) == record::csv_table(written.rows));
  CHECK(record::csv_table(read.transitions) == record::csv_table(written.transitions));
  CHECK(record::csv_table(read.barriers) == record::csv_table(written.barriers));
  CHECK(std::isnan(read.barriers[1].back_mJ));
  CHECK(record::csv_table(written.transitions) ==
        "from,to,by,count\niv.1,other.2,released,1\niv.1,,pushed,7\n");
  CHECK(read.rows[1].barrier_mJ == 0.25);
  CHECK(std::isnan(read.rows[0].barrier_mJ));
  CHECK(text_of(json_of(read.search)) == text_of(json_of(written.search)));
  CHECK(std::isnan(read.rows[0].eigenvalue_N_per_mm2));
  CHECK(read.rows[0].lives_to == 0.0325);
}

TEST_CASE("states to draw: the lowest, the lowest of each class, then those met most often") {
  std::vector<record::StateRow> rows(5);
  for (int k = 0; k < 5; ++k) rows[std::size_t(k)].count = k;
  rows[0].kind = rows[1].kind = record::StateClass::ii;
  CHECK(record::states_to_draw(rows, 1) == std::vector<std::size_t>{0});
  CHECK(record::states_to_draw(rows, 3) == std::vector<std::size_t>{0, 3, 4});
  CHECK(record::states_to_draw(rows, 9).size() == 5);
  rows[0].kind = record::StateClass::other;
  CHECK(record::states_to_draw(rows, 3) == std::vector<std::size_t>{0, 1, 4});
  CHECK(record::states_to_draw({}, 3).empty());
}

TEST_CASE("state tables of earlier versions: a number that has no column is unknown") {
  const TemporaryFolder folder;
  record::StateTables written = sample();
  written.barriers.clear();
  written.transitions.clear();
  REQUIRE(record::write_state_tables(folder, written));
  // the tables of a version that computed no barriers
  std::string table = record::csv_table(written.rows), older;
  for (std::size_t from = 0; from < table.size();) {
    const std::size_t end = table.find('\n', from);
    older += table.substr(from, table.rfind(',', end) - from) + "\n";
    from = end + 1;
  }
  std::string search = text_of(json_of(written.search));
  const auto cut = search.find(",", search.find("cpu_s"));
  REQUIRE(write_file(folder / "states.csv", older));
  REQUIRE(write_file(folder / "states.json", search.substr(0, cut) + "}"));
  const auto read = value_of(record::read_state_tables(folder));
  CHECK(read.rows.size() == 2);
  CHECK(read.rows[0].kind == record::StateClass::iv);
  CHECK(read.rows[0].lives_to == 0.0325);
  CHECK(std::isnan(read.rows[1].barrier_mJ));
  CHECK(read.search.trials == 900);
  CHECK(read.search.paths_followed_for_barriers == 0);
  // and before all terms of the energy were kept
  REQUIRE(write_file(folder / "states.csv",
                     "state,class,group,energy_bend_mJ,energy_stretch_mJ,inflections,count,"
                     "count_confined\n1,iv,C4v,39.9,0.1,2 | 2,6,0\n"));
  const auto two_terms = value_of(record::read_state_tables(folder));
  CHECK(std::isnan(two_terms.rows.at(0).energies[Term::twist]));
  CHECK(two_terms.rows.at(0).energy_mJ() == Approx(40));
  // states were numbers, and what disturbed them had other words
  REQUIRE(write_file(folder / "transitions.csv", "from,to,by,count\n1,1,let out,1\n1,0,poked,4\n"));
  const auto older_words = value_of(record::read_state_tables(folder));
  CHECK(older_words.transitions[0].from.text() == "iv.1");
  CHECK(older_words.transitions[0].by == record::Disturbance::released);
  CHECK(older_words.transitions[1].by == record::Disturbance::pushed);
  CHECK(older_words.transitions[1].to == 0);
  // a column that must not be missing, and tables that no version wrote
  for (const char* heading : {"state,group\n", "state,state\n", "from,to\n"}) {
    REQUIRE(write_file(folder / "states.csv", heading));
    CHECK_THAT(refusal(record::read_state_tables(folder)), Catch::Contains("first line"));
  }
}

TEST_CASE("state tables: damaged ones are refused with file and line") {
  const TemporaryFolder folder;
  const record::StateTables written = sample();
  REQUIRE(record::write_state_tables(folder, written));
  const auto refused = [&](const char* name, const std::string& text, const std::string& says) {
    REQUIRE(write_file(folder / name, text));
    CHECK_THAT(refusal(record::read_state_tables(folder)), Catch::Contains(says));
    REQUIRE(record::write_state_tables(folder, written));
  };
  const std::string table = record::csv_table(written.rows);
  refused("states.csv", "", "first line");
  refused("states.csv", table + "3,iv\n", "line 4");
  refused("states.csv", table + table.substr(table.find('\n') + 1) + "x", "line 6");
  auto wrong = table;
  wrong.replace(wrong.find(",iv,"), 4, ",vi,");
  refused("states.csv", wrong, "class");
  refused("states.json", "{", "states.json");
  refused("states.json", R"({"mode": 3})", "states.json");
  for (const char* number : {"1e300", "2.5", "4000000000", "18446744073709551615", "true"}) {
    std::string search = text_of(json_of(written.search));
    const auto at = search.find("900", search.find("\"trials\""));
    REQUIRE(at != std::string::npos);
    refused("states.json", search.replace(at, 3, number), "\"trials\": got ");
  }
  refused("transitions.csv", "from,to\n", "first line");
  refused("transitions.csv", "from,to,by,count\niv.1,iv.7,pushed,1\n", "does not have");
  refused("transitions.csv", "from,to,by,count\niv.1,iv.1,kicked,1\n", "its by");
  refused("barriers.csv", "from,to,energy_mJ,barrier_mJ,back_mJ,residual_N\n1,2,x,,,\n",
          "energy_mJ");
}

TEST_CASE("a state is named by class and number, and a dome has no rod of higher order") {
  record::StateRow row;
  row.state = 2;
  CHECK(row.name() == "other.2");
  row.kind = record::StateClass::ii;
  CHECK(row.name() == "ii.2");
  CHECK_FALSE(row.first_order());  // not known
  row.inflections = "0 0 | 0 0";
  CHECK(row.first_order());
  row.inflections = "0 0 | 10 0";
  CHECK_FALSE(row.first_order());
}
