#include "spincat/report/text.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "spincat/classify/model_data.h"
#include "spincat/report/text_table.h"

namespace spincat {
namespace {

TEST(TextWidth, CountsColumns) {
  EXPECT_EQ(text_width(""), 0U);
  EXPECT_EQ(text_width("chair"), 5U);
  EXPECT_EQ(text_width("étagère"), 7U);
  EXPECT_EQ(text_width("椅子"), 4U);            // wide
  EXPECT_EQ(text_width("🪑"), 2U);            // and so are emoji
  EXPECT_EQ(text_width("e\u0301t\u00e9"), 3U);  // an accent of its own combines
  EXPECT_EQ(text_width("בית"), 3U);
  EXPECT_EQ(text_width("\xFF\xC3"), 2U);  // no UTF-8: as the '?' that printable makes of it
}

TEST(CutInTheMiddle, KeepsWhatFits) {
  EXPECT_EQ(cut_in_the_middle("abcdef", 6), "abcdef");
  EXPECT_EQ(cut_in_the_middle("étagère", 7), "étagère");
  EXPECT_EQ(cut_in_the_middle("", 0), "");
}

TEST(CutInTheMiddle, LeavesOutTheMiddle) {
  EXPECT_EQ(cut_in_the_middle("abcdefgh", 5), "ab…gh");
  EXPECT_EQ(cut_in_the_middle("abcdefgh", 4), "a…gh");
  EXPECT_EQ(cut_in_the_middle("abcdefgh", 1), "…");
  EXPECT_EQ(cut_in_the_middle("abcdefgh", 0), "");
}

TEST(CutInTheMiddle, NeverCutsInsideACodePoint) {
  EXPECT_EQ(cut_in_the_middle("éèêëàâäùûü", 5), "éè…ûü");
  for (std::size_t width = 0; width < 12; ++width) {
    EXPECT_EQ(text_width(cut_in_the_middle("éèêëàâäùûü", width)), std::min<std::size_t>(width, 10));
  }
}

TEST(CutInTheMiddle, KeepsWideCharactersAndAccentsWhole) {
  EXPECT_EQ(cut_in_the_middle("椅子椅子椅子", 7), "椅…子");  // 3 columns on either side hold one of them
  EXPECT_EQ(cut_in_the_middle("椅子椅子椅子", 9), "椅子…椅子");
  EXPECT_EQ(cut_in_the_middle("ae\u0301xxxxe\u0301b", 5), "ae\u0301…e\u0301b");
  EXPECT_EQ(cut_in_the_middle("abxxxxxe\u0301b", 4), "a…e\u0301b");
  for (std::size_t width = 0; width < 20; ++width) {
    EXPECT_LE(text_width(cut_in_the_middle("椅a子e\u0301椅子bc椅子🪑de", width)), width);
  }
}

TEST(Printable, ReplacesWhatTurnsTheDirection) {
  EXPECT_EQ(printable("a\u202Egnp.exe"), "a?gnp.exe");
  EXPECT_EQ(printable("\u202A\u2066x\u2069"), "??x?");
  EXPECT_EQ(printable("בית \u2029\u202F\u2065"),
            "בית \u2029\u202F\u2065");  // their neighbours, and what runs that way by itself
}

TEST(Printable, ReplacesControlCharacters) {
  EXPECT_EQ(printable("a\x1B[31mb\n\t\x7F"), "a?[31mb???");
  EXPECT_EQ(printable(std::string_view("\0x", 2)), "?x");
  EXPECT_EQ(printable("étagère 椅子"), "étagère 椅子");
}

TEST(Printable, ReplacesTheUpperControlCharacters) {
  // U+009B is ESC [ in one character; as a byte of its own it is the same on an 8-bit terminal.
  EXPECT_EQ(printable("a\xC2\x9B"
                      "31m"),
            "a?31m");
  EXPECT_EQ(printable("a\x9B"
                      "31m"),
            "a?31m");
  EXPECT_EQ(printable("\xC2\xA0"), "\xC2\xA0");  // the first after them
}

TEST(Printable, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable("caf\xE9"), "caf?");
  EXPECT_EQ(printable("\xE6\xA4"), "??");
  EXPECT_EQ(printable("\xFF\xFE!"), std::string(2, '?') + "!");
  EXPECT_EQ(printable("\xE6(\xA4"), "?(?");
}

TEST(TextTable, AlignsColumnsWithoutTrailingBlanks) {
  TextTable table({Align::left, Align::right, Align::left});
  table.add({"étagère", "7", "x"});
  table.add({"a", "1234", ""});
  EXPECT_EQ(table.str(), "étagère     7  x\na        1234\n");
  EXPECT_EQ(TextTable({Align::left}).str(), "");
}

TEST(TextTable, ColoursCellsWithoutShiftingThem) {
  TextTable table({Align::left, Align::right, Align::left});
  table.add({"a", Cell("7", "1;34"), "x"});
  table.add({"b", "1234", Cell("", "31")});
  EXPECT_EQ(table.str(), "a     7  x\nb  1234\n");
  EXPECT_EQ(table.str(true), "a     \033[1;34m7\033[0m  x\nb  1234  \033[31m\033[0m\n");
}

TEST(Wrapped, BreaksAtBlanks) {
  EXPECT_EQ(wrapped("one two three", 13), "one two three");
  EXPECT_EQ(wrapped("one two three", 12), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", 8, 2), "one two\n  three");
  EXPECT_EQ(wrapped("étagère étagère", 7), "étagère\nétagère");
  EXPECT_EQ(wrapped("a verylongword b", 5), "a\nverylongword\nb");
  EXPECT_EQ(wrapped("key  value", 20), "key  value");
  EXPECT_EQ(wrapped("one two\nthree\n", 4, 1), "one\n two\n three\n");
  EXPECT_EQ(wrapped("", 4), "");
}

TEST(ProgressLine, ShowsRateAndTimeLeft) {
  EXPECT_EQ(progress_line("describing", 30, 120, 10.0, 79),
            "describing           [######..................] 30/120  3.0/s  30.0 s left");
  EXPECT_EQ(progress_line("describing", 1, 3, 20.0, 100),
            "describing           [########................] 1/3  20.0 s each  40.0 s left");
  EXPECT_EQ(progress_line("describing", 3, 3, 0.001, 100),
            "describing           [########################] 3/3  3000/s  0.0 ms left");
  EXPECT_EQ(progress_line("describing", 0, 3, 5.0, 100), "describing           [........................] 0/3");
}

TEST(ProgressLine, NeverIsWiderThanTheTerminal) {
  for (std::size_t width = 1; width < 120; ++width) {
    for (const char* const stage : {"x", "a stage of the work with a long name é"}) {
      EXPECT_LE(text_width(progress_line(stage, 1234, 99999, 3.0, width)), width);
    }
  }
  EXPECT_EQ(progress_line("describing", 30, 120, 10.0, 48), "describing 30/120  3.0/s  30.0 s left");
}

TEST(HumanSeconds, ChoosesTheUnit) {
  EXPECT_EQ(human_seconds(0.0), "0.0 ms");
  EXPECT_EQ(human_seconds(0.0013), "1.3 ms");
  EXPECT_EQ(human_seconds(0.25), "250 ms");
  EXPECT_EQ(human_seconds(0.9994), "999 ms");
  EXPECT_EQ(human_seconds(0.9996), "1.0 s");
  EXPECT_EQ(human_seconds(12.44), "12.4 s");
  EXPECT_EQ(human_seconds(59.94), "59.9 s");
  EXPECT_EQ(human_seconds(59.96), "1 min 0 s");
  EXPECT_EQ(human_seconds(200), "3 min 20 s");
  EXPECT_EQ(human_seconds(3599.4), "59 min 59 s");
  EXPECT_EQ(human_seconds(3599.6), "1 h 0 min");
  EXPECT_EQ(human_seconds(7325), "2 h 2 min");
}

Evaluation three_categories() {
  Evaluation e;
  e.dataset = "furniture";
  e.categories = {"chair", "étagère", "table\x1B"};
  e.object_counts = {10, 5, 1};
  e.splits = 4;
  e.mean_class_rate = {0.75, 0.0256, {0.7, 0.8}};
  e.overall_rate = {0.8, 0.01, {0.75, 0.85}};
  e.confusion = {{7, 1, 0}, {2, 2, 0}, {0, 0, 0}};
  e.wall_seconds = 12.4;
  return e;
}

TEST(EvaluationText, IsTheConfusionMatrixInPerCent) {
  EXPECT_EQ(evaluation_text(three_categories(), 100),
            "truth \\ named as, %  objects  chair  étagère  table?\n"
            "chair                     10     88       12       .\n"
            "étagère                    5     50       50       .\n"
            "table?                     1      .        .       .\n"
            "\n"
            "mean-class rate  0.750 ± 0.026   95 % interval 0.700 to 0.800\n"
            "overall rate     0.800 ± 0.010   95 % interval 0.750 to 0.850\n"
            "16 objects, 3 categories, mean and standard deviation over 4 splits, 12.4 s\n");
}

TEST(EvaluationText, CutsLongNamesThenFallsBackToLists) {
  const std::string cut = evaluation_text(three_categories(), 51);  // whole it is 52 columns wide
  EXPECT_EQ(cut.substr(0, cut.find('\n')), "truth \\ named as, %  objects  chair  ét…ère  table?");
  EXPECT_LE(widest_line(cut.substr(0, cut.find("\nmean-class"))), 51U);
  const std::string narrow = evaluation_text(three_categories(), 50);
  EXPECT_EQ(narrow.substr(0, narrow.find("\nmean-class")),
            "category  objects  right\n"
            "chair          10   88 %\n"
            "étagère         5   50 %\n"
            "table?          1      -\n"
            "\n"
            "most often confused  named as  of its objects\n"
            "étagère              chair               50 %\n"
            "chair                étagère             12 %\n");
}

TEST(EvaluationText, FitsEightyColumnsHoweverLongTheNames) {
  Evaluation e = three_categories();
  e.categories = {std::string(200, 'a'), std::string(90, 'b'), "table"};
  e.protocol = Protocol::across;
  e.test_dataset = "a folder with quite a long name/and another one below it/of objects";
  e.test_object_counts = {1, 2, 3};
  e.confidence = ConfidenceMeasure{0.9, 0.8, 0.7, 5, 0.02, 0.7};
  for (std::size_t n = 3; n < 40; ++n) {
    EXPECT_LE(widest_line(evaluation_text(e, 80)), 80U) << n << " categories\n" << evaluation_text(e, 80);
    e.categories.push_back(std::string(30, 'c') + std::to_string(n));
    e.object_counts.push_back(1000);
    for (auto& row : e.confusion) {
      row.push_back(1);
    }
    e.confusion.push_back(std::vector<std::uint32_t>(n + 1, 7));
  }
}

TEST(EvaluationText, ColoursWhatIsRightAndWrong) {
  const std::string plain = evaluation_text(three_categories(), 100);
  EXPECT_EQ(plain.find('\033'), std::string::npos);
  std::string coloured = evaluation_text(three_categories(), 100, true);
  EXPECT_NE(coloured.find("\033[32m88\033[0m       \033[31m12\033[0m"), std::string::npos) << coloured;
  EXPECT_NE(coloured.find("\033[1;31m50\033[0m       \033[32m50\033[0m"), std::string::npos) << coloured;
  for (std::size_t at = coloured.find('\033'); at != std::string::npos; at = coloured.find('\033')) {
    coloured.erase(at, coloured.find('m', at) + 1 - at);
  }
  EXPECT_EQ(coloured, plain);
}

TEST(EvaluationText, FallsBackWithoutAnyConfusion) {
  Evaluation e = three_categories();
  e.confusion = {{8, 0, 0}, {0, 4, 0}, {0, 0, 1}};
  const std::string text = evaluation_text(e, 10);
  EXPECT_EQ(text.find("confused"), std::string::npos);
  EXPECT_NE(text.find("100 %"), std::string::npos);
}

std::string last_lines(const Evaluation& e) {
  const std::string text = evaluation_text(e, 160);
  return text.substr(text.find("\n\n") + 2);
}

TEST(EvaluationText, NamesTheSeedsWhereThereAreSeveral) {
  Evaluation e = three_categories();
  e.split_seeds = {3, 4};
  e.seeds = {{3, {0.7, 0.0, {}}, {}}, {4, {0.8, 0.0, {}}, {}}};
  EXPECT_EQ(last_lines(e),
            "mean-class rate  0.750 ± 0.026   95 % interval 0.700 to 0.800\n"
            "overall rate     0.800 ± 0.010   95 % interval 0.750 to 0.850\n"
            "seeds 3, 4  0.700  0.800   (mean-class rate over 4 splits each)\n"
            "16 objects, 3 categories, mean and standard deviation over 8 splits, 12.4 s\n");
}

TEST(EvaluationText, OfAnotherDataSetHasNoSpread) {
  Evaluation e = three_categories();
  e.protocol = Protocol::across;
  e.test_dataset = "others\n";
  e.test_object_counts = {1, 2, 3};
  EXPECT_EQ(last_lines(e),
            "mean-class rate  0.750   95 % interval 0.700 to 0.800\n"
            "overall rate     0.800   95 % interval 0.750 to 0.850\n"
            "16 objects, 3 categories, tested on 6 objects of others?, 12.4 s\n");
  e.protocol = Protocol::leave_one_out;
  EXPECT_NE(last_lines(e).find("3 categories, each object named by judges trained on all others, "), std::string::npos);
}

TEST(EvaluationText, TellsWhatTheConfidenceTells) {
  Evaluation e = three_categories();
  e.confidence = ConfidenceMeasure{0.9, 0.8, 0.7, 0, 0.02, 0.7};
  EXPECT_NE(last_lines(e).find("confidence       0.700 on average; area under the curve 0.900 for right or wrong\n"),
            std::string::npos);
  EXPECT_NE(last_lines(e).find("turned away      2.0 % of the tested objects\n"), std::string::npos);
  e.confidence->unknown_objects = 5;
  EXPECT_NE(last_lines(e).find("turned away      2.0 % of the tested objects, 70.0 % of the unknown objects\n"),
            std::string::npos);
  EXPECT_NE(last_lines(e).find("0.900 for right or wrong, 0.800 for known or unknown (5 unknown objects)\n"),
            std::string::npos);
}

TEST(BallotText, ShowsTheWinnersJudgesFirstThenByStrength) {
  const Ballot ballot = count_votes(3, std::vector<float>{-0.5F, 2.0F, 1.25F});  // 1 wins: over 0, over 2
  EXPECT_EQ(ballot_text(ballot, {"bed", "chair", "table\n"}),
            "     chair  not table?  1.25\n"
            "     chair  not bed     0.50\n"
            "     bed    not table?  2.00\n");
}

TEST(BallotText, NamesHowATieWasBroken) {
  const std::vector<std::string> names = {"a", "b", "c"};
  EXPECT_NE(ballot_text(count_votes(3, std::vector<float>{1.0F, -1.5F, 3.0F}), names)
                .find("a tie, broken by the sum of the margins\n"),
            std::string::npos);
  EXPECT_NE(ballot_text(count_votes(3, std::vector<float>{2.0F, -2.0F, 2.0F}), names)
                .find("a tie, broken by the order of the categories\n"),
            std::string::npos);
}

TEST(ObjectText, NamesOnlyTheDefectsThereAre) {
  ObjectFacts facts;
  facts.is_mesh = true;
  facts.points = 8;
  facts.triangles = 12;
  facts.high = Vec3(1, 2, 3);
  facts.area = 22;
  facts.resolution = 2;
  facts.flat_triangles = 3;
  EXPECT_EQ(object_text(facts),
            "kind                    mesh\n"
            "vertices                8\n"
            "triangles               12\n"
            "size                    1 x 2 x 3\n"
            "area                    22\n"
            "resolution              2\n"
            "triangles without area  3\n");
  facts.is_mesh = false;
  facts.has_normals = true;
  EXPECT_EQ(object_text(facts).substr(0, object_text(facts).find("triangles")).find("area"), std::string::npos);
  EXPECT_NE(object_text(facts).find("point cloud with normals"), std::string::npos);
}

TEST(ModelText, SaysWhatWasLearnt) {
  ModelData model;
  model.settings = preset("default");
  model.categories = {"bed", "chair\x07"};
  model.object_counts = {9, 69};
  model.judges.weights.resize(1, 4800);
  model.judges.support_vectors = {7};
  model.made_by = "spincat 0.1.0";
  model.dataset = "furniture";
  const std::string text = model_text(model);
  EXPECT_LE(widest_line(model_text(model, 60)), 60U);
  EXPECT_GT(widest_line(text), 60U);
  for (const char* part : {"spincat 0.1.0", "furniture", "bed (9), chair? (69)", "1 of 4800 features",
                           "angle test soft", "seed 1", "copies 6", "kernel linear, dimensions 200, c 10"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
}

}  // namespace
}  // namespace spincat
