#include "engine/core/version.h"

namespace gridshell {

const char* version() { return GRIDSHELL_VERSION; }

}  // namespace gridshell
