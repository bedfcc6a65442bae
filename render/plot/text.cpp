#include "render/plot/text.h"

#include <algorithm>
#include <cstring>

#include "render/plot/canvas.h"

namespace gridshell::render {
namespace {

// position of the unescaped `mark` at or after `from`, or npos
std::size_t find_mark(const std::string& text, char mark, std::size_t from) {
  for (std::size_t k = from; k < text.size(); ++k) {
    if (text[k] == '\\')
      ++k;
    else if (text[k] == mark)
      return k;
  }
  return std::string::npos;
}

void append(std::vector<TextRun>& runs, const TextRun& look, char letter) {
  if (runs.empty() || runs.back().level != look.level || runs.back().slanted != look.slanted)
    runs.push_back({"", look.level, look.slanted});
  runs.back().text += letter;
}

void parse(const std::string& text, TextRun look, std::vector<TextRun>& runs) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '\\' && k + 1 < text.size()) {
      append(runs, look, text[++k]);
      continue;
    }
    const bool script = (c == '_' || c == '^') && k + 1 < text.size() && text[k + 1] == '{';
    if (script || c == '*') {
      const std::size_t start = k + (script ? 2 : 1);
      const std::size_t end = find_mark(text, script ? '}' : '*', start);
      if (end != std::string::npos) {
        TextRun inner = look;
        if (script)
          inner.level = c == '_' ? -1 : 1;
        else
          inner.slanted = true;
        parse(text.substr(start, end - start), inner, runs);
        k = end;
        continue;
      }
    }
    append(runs, look, c);
  }
}

}  // namespace

std::string plain(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    if (std::strchr("_^*{}\\", c) && c != '\0') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::vector<TextRun> parse_marked(const std::string& marked) {
  std::vector<TextRun> runs;
  parse(marked, {}, runs);
  return runs;
}

std::string without_marks(const std::string& marked) {
  std::string letters;
  for (const TextRun& run : parse_marked(marked)) letters += run.text;
  return letters;
}

std::string spaced(std::string word) {
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

}  // namespace gridshell::render
