#include "engine/record/trust.h"

#include "engine/record/csv.h"

namespace gridshell::record {

bool silently_wrong(TrustClass found) {
  return found == TrustClass::estimate_small || found == TrustClass::other_branch ||
         found == TrustClass::inner_unphysical || found == TrustClass::frame_dependent;
}

std::string trust_csv(const std::vector<TrustRow>& rows) {
  Csv csv;
  csv.line("scene", "kind", "class", "error", "estimate", "exit_default", "exit_fine",
           "snap_default", "snap_fine", "doubt");
  for (const TrustRow& row : rows)
    csv.line(row.scene, row.kind, std::string(word_of(row.found)), row.error, row.estimate,
             row.exit_default, row.exit_fine, int(row.snap_default), int(row.snap_fine),
             int(row.doubt));
  return std::move(csv).text();
}

}  // namespace gridshell::record
