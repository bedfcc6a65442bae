#include "engine/core/system_info.h"

namespace gridshell {

const char* version() { return GRIDSHELL_VERSION; }

}  // namespace gridshell
