#include "camera_move.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace mpipov {
namespace {

struct Token {
    enum class Kind { word, literal, symbol } kind = Kind::symbol;
    std::string_view text;  // of a literal: between its marks
    std::size_t begin = 0, end = 0;

    bool is(char symbol) const { return kind == Kind::symbol && text.front() == symbol; }
    bool is(std::string_view word) const { return kind == Kind::word && text == word; }
};

bool in_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::size_t after_comment(std::string_view text, std::size_t at) {
    if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
    int depth = 0;  // they nest
    while (at < text.size()) {
        const std::string_view two = text.substr(at, 2);
        if (two != "/*" && two != "*/") {
            ++at;
            continue;
        }
        at += 2;
        depth += two == "/*" ? 1 : -1;
        if (depth == 0) break;
    }
    return std::min(at, text.size());
}

// Behind the closing mark.
std::size_t after_literal(std::string_view text, std::size_t at) {
    for (++at; at < text.size() && text[at] != '"'; ++at)
        if (text[at] == '\\' && at + 1 < text.size()) ++at;
    return std::min(at + 1, text.size());
}

std::vector<Token> tokens_of(std::string_view text) {
    std::vector<Token> tokens;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = at;
        const std::string_view two = text.substr(at, 2);
        if (two == "//" || two == "/*") {
            at = after_comment(text, at);
        } else if (text[at] == '"') {
            at = after_literal(text, at);
            const std::size_t length = at - begin < 2 ? 0 : at - begin - 2;
            tokens.push_back({Token::Kind::literal, text.substr(begin + 1, length), begin, at});
        } else if (in_word(text[at])) {
            while (at < text.size() && in_word(text[at])) ++at;
            tokens.push_back({Token::Kind::word, text.substr(begin, at - begin), begin, at});
        } else {
            ++at;
            if (std::isspace(static_cast<unsigned char>(text[begin])) == 0)
                tokens.push_back({Token::Kind::symbol, text.substr(begin, 1), begin, at});
        }
    }
    return tokens;
}

bool is_include(const std::vector<Token>& tokens, std::size_t i) {
    return i >= 2 && tokens[i].kind == Token::Kind::literal && tokens[i - 1].is("include") &&
           tokens[i - 2].is('#');
}

// `camera {` that is none of a declaration, of an array's values or of #default.
bool is_camera_statement(const std::vector<Token>& tokens, std::size_t i) {
    if (!tokens[i].is("camera") || i + 1 >= tokens.size() || !tokens[i + 1].is('{')) return false;
    if (i == 0) return true;
    const Token& before = tokens[i - 1];
    return !before.is('=') && !before.is(',') && !before.is('{') && !before.is('(');
}

// Which token closes the brace that token `open` is; none where the text ends first.
std::optional<std::size_t> closing(const std::vector<Token>& tokens, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
        if (tokens[i].is('{')) ++depth;
        if (tokens[i].is('}') && --depth == 0) return i;
    }
    return {};
}

std::string movement() {
    return fmt::format("\n#debug \"\\n{}\\n\"\nscale 1 + {}\ntranslate {} * <0.36, 0.48, 0.8>\n",
                       camera_mark, camera_move_name, camera_shift_name);
}

struct Edit {
    std::size_t begin = 0, end = 0;
    std::string text;
};

}  // namespace

SceneText read_scene_text(std::string_view text) {
    const std::vector<Token> tokens = tokens_of(text);
    SceneText found;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (is_include(tokens, i)) found.includes.emplace_back(tokens[i].text);
        if (is_camera_statement(tokens, i) && closing(tokens, i + 1)) ++found.cameras;
        if (tokens[i].is(camera_move_name)) found.moves_itself = true;
    }
    return found;
}

std::string with_movable_camera(std::string_view text,
                                const std::map<std::string, std::string>& includes) {
    const std::vector<Token> tokens = tokens_of(text);
    std::vector<Edit> edits;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (is_include(tokens, i))
            if (const auto other = includes.find(std::string(tokens[i].text));
                other != includes.end())
                edits.push_back({tokens[i].begin, tokens[i].end, '"' + other->second + '"'});
        if (!is_camera_statement(tokens, i)) continue;
        if (const auto end = closing(tokens, i + 1))
            edits.push_back({tokens[*end].begin, tokens[*end].begin, movement()});
    }
    std::sort(edits.begin(), edits.end(),
              [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
    std::string changed;
    std::size_t at = 0;
    for (const Edit& edit : edits) {
        changed += text.substr(at, edit.begin - at);
        changed += edit.text;
        at = edit.end;
    }
    changed += text.substr(at);
    return changed;
}

std::string movable_default_camera() {
    return "\ncamera {" + movement() + "}\n";
}

}  // namespace mpipov
