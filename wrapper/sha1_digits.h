// A SHA-1 as sha1sum prints it.
#pragma once

#include "letter_case.h"

#include <OpenImageIO/hash.h>

#include <string>

namespace mpipov {

// 40 hexadecimal digits; OpenImageIO's own are in upper case, unlike everybody else's.
inline std::string sha1_digits(OIIO::SHA1& sha) {
    return lower(sha.digest());
}

inline std::string sha1_of_text(const std::string& text) {
    OIIO::SHA1 sha(text.data(), text.size());
    return sha1_digits(sha);
}

}  // namespace mpipov
