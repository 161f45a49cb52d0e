// Settings from text and to text, by the types of their members.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <optional>
#include <type_traits>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/error.h"
#include "spincat/settings/setting_names.h"
#include "spincat/settings/setting_table.h"

namespace spincat {
namespace {

template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

[[noreturn]] void refuse(std::string_view label, std::string_view text, const std::string& expected) {
  throw InputError(fmt::format("{} {}: expected {}", label, text, expected));
}

// One value of one type: how it is read, written, and which words it may take.
struct Text {
  std::string_view label;
  std::string_view text;
  const Range& range;

  void into(int& value) const {
    const auto number = parsed<int>(text);
    if (!number) {
      refuse(label, text, "a whole number, " + range.text());
    }
    check_range(label, *number, range);
    value = *number;
  }
  void into(double& value) const {
    const auto number = parsed<double>(text);
    if (!number) {
      refuse(label, text, "a number");
    }
    check_range(label, *number, range);
    value = *number;
  }
  void into(bool& value) const {
    if (text != "true" && text != "false") {
      refuse(label, text, "true or false");
    }
    value = text == "true";
  }
  void into(std::uint64_t& value) const {
    const auto number = parsed<std::uint64_t>(text);
    if (!number) {
      refuse(label, text, "a whole number from 0");
    }
    value = *number;
  }
  void into(std::string& value) const {
    make_encoding(text);  // the only name among the settings
    value = text;
  }
  template <class Choice>
  void into(Choice& value) const {
    value = choice_of<Choice>(label, text);
  }
};

std::string text_of(bool value) {
  return value ? "true" : "false";
}
std::string text_of(const std::string& value) {
  return value;
}
template <class Value>
std::string text_of(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return std::string(name_of(value));
  } else {
    return fmt::format("{}", value);
  }
}

template <class Value>
std::string words_of(const Value& /*value*/) {
  std::vector<std::string_view> words;
  if constexpr (std::is_enum_v<Value>) {
    for (const auto& each : choices<Value>()) {
      words.push_back(each.name);
    }
  } else if constexpr (std::is_same_v<Value, std::string>) {
    words.assign(encoding_names().begin(), encoding_names().end());
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

struct Unit {
  std::string_view ending;
  BinSizeUnit unit;
};
constexpr Unit kUnitEndings[] = {
    {"abs", BinSizeUnit::absolute}, {"res", BinSizeUnit::resolution}, {"rel", BinSizeUnit::relative}};

void set_bin_size(Settings& settings, std::string_view text, std::string_view label) {
  std::string_view number = text;
  std::optional<BinSizeUnit> unit;
  for (const auto& [ending, each] : kUnitEndings) {
    if (text.ends_with(ending)) {
      number.remove_suffix(ending.size());
      unit = each;
    }
  }
  const auto size = parsed<double>(number);
  if (!size) {
    refuse(label, text, "a number, maybe followed by abs, res or rel, as in 0.05rel");
  }
  check_range(label, *size, SpinImageParams::kBinSize);
  settings.spin.bin_size = *size;
  settings.bin_size_unit = unit.value_or(settings.bin_size_unit);
}

}  // namespace

std::string setting_words(const Setting& setting) {
  Settings any;
  return std::visit([](const auto* member) { return words_of(*member); }, setting.member(any));
}

std::string setting_text(const Settings& settings, const Setting& setting) {
  Settings copy = settings;  // a member is reached through settings that may change
  return std::visit([](const auto* member) { return text_of(*member); }, setting.member(copy));
}

void set_setting(Settings& settings, const Setting& setting, std::string_view text, std::string_view label) {
  if (!is_setting_text(text)) {
    throw InputError(fmt::format("{}: its value is too long or not printable", label));
  }
  if (setting.name == "bin_size") {
    set_bin_size(settings, text, label);
    return;
  }
  std::visit([&](auto* member) { Text{label, text, setting.range}.into(*member); }, setting.member(settings));
}

}  // namespace spincat
