#include "number_check.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace mpipov {

CLI::Validator finite_number(std::string what, std::string shown, bool (*good)(double)) {
    const auto check = [what = std::move(what), good](const std::string& text) {
        double value = 0;
        const bool accepted =
            CLI::detail::lexical_cast(text, value) && std::isfinite(value) && good(value);
        return accepted ? std::string() : fmt::format("'{}' is no {}", text, what);
    };
    return {check, std::move(shown)};
}

}  // namespace mpipov
