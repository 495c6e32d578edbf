// A SHA-1 as sha1sum prints it.
#pragma once

#include <OpenImageIO/hash.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace mpipov {

// 40 hexadecimal digits; OpenImageIO's own are in upper case, unlike everybody else's.
inline std::string sha1_digits(OIIO::SHA1& sha) {
    std::string digits = sha.digest();
    std::transform(digits.begin(), digits.end(), digits.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return digits;
}

}  // namespace mpipov
