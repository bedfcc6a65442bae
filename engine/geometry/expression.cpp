#include "engine/geometry/expression.h"

#include <muParser.h>

#include <limits>
#include <string_view>

namespace gridshell {
namespace {

/// Whether a sign of equality stands in it that is no part of ==, <=, >= or !=.
bool is_equation(std::string_view text) {
  for (std::size_t k = 1; k + 1 < text.size(); ++k)
    if (text[k] == '=' && text[k + 1] != '=' &&
        std::string_view("=<>!").find(text[k - 1]) == std::string_view::npos)
      return true;
  return false;
}

}  // namespace

struct Expression::Parsed {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  mu::Parser parser;
};

Result<Expression> Expression::parse(const std::string& text) {
  if (is_equation(text)) return fail(Fault::bad_input, "an equation, must be one side of it alone");
  auto parsed = std::make_shared<Parsed>();
  try {
    parsed->parser.DefineVar("x", &parsed->point.x());
    parsed->parser.DefineVar("y", &parsed->point.y());
    parsed->parser.DefineVar("z", &parsed->point.z());
    parsed->parser.SetExpr(text);
    int values = 0;
    parsed->parser.Eval(values);
    if (values != 1) return fail(Fault::bad_input, "{} values, must be one", values);
  } catch (const mu::Parser::exception_type& wrong) {
    return fail(Fault::bad_input, "{} (at place {})", wrong.GetMsg(), int(wrong.GetPos()) + 1);
  }
  return Expression(text, std::move(parsed));
}

double Expression::at(const Eigen::Vector3d& point) const {
  parsed_->point = point;
  try {
    return parsed_->parser.Eval();
  } catch (const mu::Parser::exception_type&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace gridshell
