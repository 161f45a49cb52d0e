// Pages: what is in the file. What a browser makes of it is in browser/check_pages.py.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "spincat/report/json.h"
#include "spincat/report/report.h"
#include "spincat/report/sweep_report.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kCommand = {"spincat", "evaluate", "</script><script>alert(1)"};
const std::string kNasty = "<b>\"bed\" & 'couch'</script><!-- {{script}} 🪑 בית";

Evaluation nasty_evaluation() {
  Evaluation e;
  e.dataset = kNasty;
  e.categories = {kNasty, "chair"};
  e.object_counts = {1, 1};
  e.splits = 1;
  e.split_seeds = {1};
  e.category_rates = {{1.0, 0.0, {0.2, 1.0}}, {0.0, 0.0, {0.0, 0.8}}};
  e.confusion = {{1, 0}, {1, 0}};
  e.tested = {{kNasty + ".off", 0, {0}}, {"b\xFF.off", 1, {0}}};
  return e;
}

// The text of the element with this id.
std::string element(const std::string& page, const std::string& id) {
  const std::string begin = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find("</script>", from) - from);
}

std::size_t count(const std::string& text, const std::string& wanted) {
  std::size_t found = 0;
  for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) {
    ++found;
  }
  return found;
}

TEST(EvaluationPage, HoldsTheJsonAndWhatEachObjectWasNamed) {
  const Evaluation e = nasty_evaluation();
  const Json data = Json::parse(element(evaluation_page(e, preset("paper"), {}, kCommand), "data"));
  EXPECT_EQ(data["kind"], "evaluation");
  EXPECT_EQ(data["result"], Json::parse(evaluation_json(e, preset("paper"), {}, kCommand)));
  EXPECT_EQ(data["tested"]["files"][0], kNasty + ".off");
  EXPECT_EQ(data["tested"]["files"][1], "b\xEF\xBF\xBD.off");  // U+FFFD for what is no UTF-8
  EXPECT_EQ(data["tested"]["truth"].dump(), "[0,1]");
  EXPECT_EQ(data["tested"]["named"].dump(), "[[0],[0]]");
}

TEST(EvaluationPage, NamesNeverBecomeMarkup) {
  const std::string page = evaluation_page(nasty_evaluation(), preset("paper"), {}, kCommand);
  Evaluation harmless = nasty_evaluation();
  harmless.dataset = "a";
  harmless.categories = {"b", "c"};
  harmless.tested[0].file = "d";
  const std::string same = evaluation_page(harmless, preset("paper"), {}, {"spincat"});
  EXPECT_GT(count(same, "<"), 10U);
  EXPECT_EQ(count(page, "<"), count(same, "<"));
  EXPECT_EQ(count(page, "</script>"), count(same, "</script>"));
}

TEST(EvaluationPage, NeedsNoNetwork) {
  const std::string page = evaluation_page(nasty_evaluation(), preset("paper"), {}, kCommand);
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0U);
  EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find(" src="), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_EQ(page.find("url("), std::string::npos);
  EXPECT_LT(page.size(), 100'000U);
}

TEST(SweepPage, HoldsTheJson) {
  Sweep sweep;
  sweep.dataset = kNasty;
  sweep.variations = {{"bin_size", {"0.1", "0.2"}}};
  sweep.points = {{{"0.1"}, {0.5, 0.1, {0.4, 0.6}}, {0.25, 0.1, {0.2, 0.3}}, {1, 2, 3, 4, 5}},
                  {{"0.2"}, {0.75, 0.1, {0.6, 0.9}}, {0.5, 0.1, {0.4, 0.6}}, {1, 2, 3, 4, 5}}};
  const std::string page = sweep_page(sweep, preset("paper"), {}, kCommand);
  const Json data = Json::parse(element(page, "data"));
  EXPECT_EQ(data["kind"], "sweep");
  EXPECT_EQ(data["result"], Json::parse(sweep_json(sweep, preset("paper"), {}, kCommand)));
}

}  // namespace
}  // namespace spincat
