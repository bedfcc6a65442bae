// Sheets of paper for the workshop: what to cut, and how it goes together.
#pragma once

#include <string>

#include "engine/record/fabrication.h"

namespace gridshell::render {

/// The cut list as a PDF as wide as A4, longer where there are many rods.
std::string cut_list_pdf(const exports::FabricationPlan& work);

/// One page of A4: the footprint and the plate in small, what is needed, the steps, and the legs
/// that are too short to build.
std::string assembly_sheet_pdf(const exports::FabricationPlan& work);

}  // namespace gridshell::render
