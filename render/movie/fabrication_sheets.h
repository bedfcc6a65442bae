// Sheets of paper for the workshop: what to cut, and how it goes together.
#pragma once

#include <string>

#include "engine/record/fabrication.h"
#include "render/canvas/sheets.h"

namespace gridshell::render {

/// Every rod with its length and marks.
void add_cut_list(Sheets& sheets, const exports::FabricationPlan& work);
/// The same as a PDF.
std::string cut_list_pdf(const exports::FabricationPlan& work);

/// One page of A4: the footprint and the plate in small, what is needed, the steps, and the legs
/// that are too short to build.
std::string assembly_sheet_pdf(const exports::FabricationPlan& work);

}  // namespace gridshell::render
