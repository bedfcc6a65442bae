// The page of page.html, in which "/*RUN*/" stands for the run.
#pragma once

namespace gridshell::exports {

extern const char* const page_template;

}  // namespace gridshell::exports
