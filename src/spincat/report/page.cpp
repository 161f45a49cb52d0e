// The pages of evaluations and sweeps.
#include <map>

#include "spincat/report/embedded.h"
#include "spincat/report/page_parts.h"
#include "spincat/report/report.h"

namespace spincat {
namespace {

// The template with each {{name}} replaced; what is put in is not looked at again.
std::string filled(std::string_view text, const std::map<std::string_view, std::string_view>& values) {
  std::string result;
  for (std::size_t begin = text.find("{{"); begin != std::string_view::npos; begin = text.find("{{")) {
    const std::size_t end = text.find("}}", begin);
    result += text.substr(0, begin);
    result += values.at(text.substr(begin + 2, end - begin - 2));
    text.remove_prefix(end + 2);
  }
  return result += text;
}

Json tested_objects(const Evaluation& evaluation) {
  Json files = Json::array();
  Json truth = Json::array();
  Json named = Json::array();
  for (const TestedObject& object : evaluation.tested) {
    files.push_back(object.file.string());
    truth.push_back(object.category);
    named.push_back(object.named);
  }
  return {{"files", files}, {"truth", truth}, {"named", named}};
}

}  // namespace

std::string json_in_html(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {  // "<" can only be inside a string, where \u003c is the same
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string page(const Json& data, const std::vector<PagePart>& parts, const std::vector<std::string_view>& scripts) {
  std::string elements;
  for (const PagePart& part : parts) {
    elements += "<script type=\"application/json\" id=\"" + part.id + "\">" + json_in_html(part.data) + "</script>\n";
  }
  std::string script(embedded::common_js());
  for (const std::string_view each : scripts) {
    script += each;
  }
  const std::string all = json_in_html(line(data));
  return filled(embedded::page_html(),
                {{"style", embedded::page_css()}, {"data", all}, {"parts", elements}, {"script", script}});
}

std::string evaluation_page(const Evaluation& evaluation, const Settings& settings, const EvaluateOptions& options,
                            const std::vector<std::string>& command) {
  const Json data = {{"kind", "evaluation"},
                     {"result", Json::parse(evaluation_json(evaluation, settings, options, command))},
                     {"tested", tested_objects(evaluation)}};
  return page(data, {}, {embedded::evaluation_js()});
}

std::string sweep_page(const Sweep& sweep, const Settings& settings, const EvaluateOptions& options,
                       const std::vector<std::string>& command) {
  const Json data = {{"kind", "sweep"}, {"result", Json::parse(sweep_json(sweep, settings, options, command))}};
  return page(data, {}, {embedded::sweep_js()});
}

}  // namespace spincat
