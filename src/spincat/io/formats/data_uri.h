// URIs as they stand in files. Private to io.
#pragma once

#include <string>
#include <string_view>

namespace spincat::io {

// Whether a URI holds its bytes itself: data:[type][;base64],...
bool is_data_uri(std::string_view uri);

// Its bytes, whatever type it names, no more than it has letters. Throws InputError where it is no data URI or not of
// the encoding that it says.
std::string decode_data_uri(std::string_view uri);

// Takes %20 and the like for what they stand for.
std::string decode_percent(std::string_view uri);

}  // namespace spincat::io
