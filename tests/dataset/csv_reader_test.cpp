#include "spincat/dataset/csv_reader.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using test::input_error;
using namespace std::string_literals;
using Fields = std::vector<std::string>;
using Rows = std::vector<std::pair<std::size_t, Fields>>;

Rows parsed(std::string_view text) {
  Rows rows;
  const std::string file = "f.csv";
  CsvParser parser(text, file);
  while (const auto row = parser.next()) {
    rows.emplace_back(row->line, row->fields);
  }
  return rows;
}

std::string error_of(std::string_view text) {
  return input_error([&] { parsed(text); });
}

TEST(CsvReader, ReadsFieldsWithTheirLines) {
  EXPECT_EQ(parsed("a,b\nc, d \n"), (Rows{{1, {"a", "b"}}, {2, {"c", " d "}}}));
  EXPECT_EQ(parsed(""), Rows{});
  EXPECT_EQ(parsed("a,\n,b"), (Rows{{1, {"a", ""}}, {2, {"", "b"}}}));
  EXPECT_EQ(parsed("a,"), (Rows{{1, {"a", ""}}}));
}

TEST(CsvReader, EndsLinesByLfCrlfOrCr) {
  EXPECT_EQ(parsed("a\nb\r\nc\rd"), (Rows{{1, {"a"}}, {2, {"b"}}, {3, {"c"}}, {4, {"d"}}}));
}

TEST(CsvReader, SkipsByteOrderMarkCommentsAndEmptyLines) {
  EXPECT_EQ(parsed("\xEF\xBB\xBF# a \"comment\r\n\r\na,#b\n#\n"), (Rows{{3, {"a", "#b"}}}));
  EXPECT_EQ(parsed("\"#a\"\n# at the end"), (Rows{{1, {"#a"}}}));
}

TEST(CsvReader, ReadsQuotedFields) {
  EXPECT_EQ(parsed("\"a,\"\"b\"\"\",\"\"\nc,d"), (Rows{{1, {"a,\"b\"", ""}}, {2, {"c", "d"}}}));
}

TEST(CsvReader, KeepsAndCountsLineEndsInsideQuotes) {
  EXPECT_EQ(parsed("\"a\r\nb\n# c\",d\ne,f"), (Rows{{1, {"a\r\nb\n# c", "d"}}, {4, {"e", "f"}}}));
}

TEST(CsvReader, RefusesQuotesThatDoNotFit) {
  EXPECT_EQ(error_of("a\n\"b\nc"), "f.csv: line 2: the quoted field that begins here never ends");
  EXPECT_EQ(error_of("a\n\"b\"c"), "f.csv: line 2: text after the closing quote of a field");
  EXPECT_EQ(error_of("a\nb\"c"),
            "f.csv: line 2: a quote inside a field (put quotes around the field and write \"\" for one inside)");
}

TEST(CsvReader, RefusesZeroBytes) {
  EXPECT_EQ(error_of("a\nb\0c"s), "f.csv: line 2: a zero byte: this is no plain text (expected UTF-8)");
  EXPECT_EQ(error_of("\"\0\""s), "f.csv: line 1: a zero byte: this is no plain text (expected UTF-8)");
}

TEST(CsvReader, RefusesRowsOfFarTooManyFields) {
  const std::string most = std::string(999, ',');
  EXPECT_EQ(parsed("a\n" + most)[1].second.size(), 1'000U);
  EXPECT_EQ(error_of("a\n" + most + ","), "f.csv: line 2: a row of more than 1000 fields");
}

TEST(CsvTable, FindsColumnsByName) {
  const test::TempDir dir;
  CsvTable table(dir.write("t.csv", "# note\npath,other,category\na,b,c\n"));
  EXPECT_EQ(table.column("category"), 2U);
  EXPECT_EQ(table.find_column("split"), std::nullopt);
  const auto row = table.next();
  ASSERT_TRUE(row);
  EXPECT_EQ(row->line, 3U);
  EXPECT_EQ(table.filled(*row, 2), "c");
  EXPECT_FALSE(table.next());
}

// The first row, and what stands in `column` of the next.
std::pair<std::size_t, std::string> column_and_field(std::string_view text, std::string_view column) {
  const test::TempDir dir;
  CsvTable table(dir.write("t.csv", text));
  const std::size_t place = table.column(column);
  const auto row = table.next();
  return {place, row ? row->fields.at(place) : "(none)"};
}

TEST(CsvTable, TakesTheSeparatorThatItsHeaderLineHas) {
  const std::pair<std::size_t, std::string> expected{1, "x,y;z"};
  EXPECT_EQ(column_and_field("path,category\na,\"x,y;z\"\n", "category"), expected);
  EXPECT_EQ(column_and_field("path;category\na;x,y\n", "category").second, "x,y");
  EXPECT_EQ(column_and_field("path\tcategory\r\na\tx,y;z\r\n", "category"), expected);
  EXPECT_EQ(column_and_field("# a;b;c\n\npath,category\na,\"x,y;z\"\n", "category"), expected);
  EXPECT_EQ(column_and_field("\xEF\xBB\xBF\"a,b,c,d\";category\na;x\n", "category").second, "x");
  EXPECT_EQ(column_and_field("sep=;\r\npath;category\r\na;x,y\r\n", "category").second, "x,y");
  EXPECT_EQ(column_and_field("\xEF\xBB\xBFsep=,\npath,category\na,x;y\n", "category").second, "x;y");
  EXPECT_EQ(column_and_field("# it's \"quoted;;;\npath,category\na,b;c\n", "category").second, "b;c");
}

TEST(CsvTable, ReadsUtf16) {
  std::string bytes = "\xFF\xFE";
  for (const char c : std::string_view("path\tcategory\na\tb\n")) {
    bytes += {c, '\0'};
  }
  EXPECT_EQ(column_and_field(bytes, "category"), (std::pair<std::size_t, std::string>{1, "b"}));
}

TEST(CsvTable, KnowsColumnsByAnyOfTheirNames) {
  const test::TempDir dir;
  CsvTable table(dir.write("t.csv", "File, Label ,file,CATEGORY\n"));
  EXPECT_EQ(table.column({"path", "file"}), 0U);
  EXPECT_EQ(table.column("label"), 1U);
  EXPECT_EQ(table.column({"category", "label"}), 3U);
  EXPECT_EQ(table.find_column({"split", "set"}), std::nullopt);
}

TEST(CsvTable, NamesWhatIsWrong) {
  const test::TempDir dir;
  const std::string file = (dir / "t.csv").string();
  const auto error = [&](std::string_view text) {
    dir.write("t.csv", text);
    return input_error([&] {
      CsvTable table(file);
      const std::size_t path = table.column("path");
      while (const auto row = table.next()) {
        table.filled(*row, path);
      }
    });
  };
  EXPECT_EQ(error("# nothing\n"), file + ": is empty (expected a header line that names the columns)");
  EXPECT_EQ(error("Pfad; x\n"),
            file +
                ": the header line names no column 'path' (found: 'Pfad', ' x'; commas, semicolons or tabs separate "
                "columns)");
  EXPECT_EQ(error("\npath,path\n"), file + ": line 2: two columns are called 'path'");
  EXPECT_EQ(error("path,a\nb,c\nd\n"), file + ": line 3: 1 field, expected 2 as in the header line");
  EXPECT_EQ(error("path,a\n,c\n"), file + ": line 2: the path is empty");
}

}  // namespace
}  // namespace spincat
