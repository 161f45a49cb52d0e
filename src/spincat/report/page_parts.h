// How a page is put together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "spincat/report/json_parts.h"

namespace spincat {

// A piece of data that a page reads only when it shows it: {"id": what the element is called, "data": ...}.
struct PagePart {
  std::string id;
  std::string data;  // JSON
};

// JSON that may stand in an HTML script element: nothing in it can end the element or begin a comment.
std::string json_in_html(std::string_view json);

// The page of `data` with the scripts, which run in their order after common_js.
std::string page(const Json& data, const std::vector<PagePart>& parts, const std::vector<std::string_view>& scripts);

}  // namespace spincat
