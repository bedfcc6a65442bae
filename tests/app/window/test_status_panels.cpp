// Texts at the bottom of the window.
#include <catch2/catch.hpp>

#include "app/window/viewer_state.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("on one mesh the error of the joints is not known") {
  Certificate certificate;
  certificate.error_estimate_mm = 0.025;
  CHECK_THAT(text_of_error(certificate), Catch::Contains("known to 0.025 mm"));
  certificate.error_estimate_mm = record::unknown;
  CHECK_THAT(text_of_error(certificate), Catch::Contains("not known"));
  CHECK_THAT(text_of_error(certificate), !Catch::Contains("nan"));
}
