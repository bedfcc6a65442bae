// Which gridshell this is.
#pragma once

namespace gridshell {

/// "0.2.0", that of the CMake project.
const char* version();

}  // namespace gridshell
