// SPDX-License-Identifier: MIT
#include "document/reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <vector>

#include "document/document.h"

namespace lodestar::document {
namespace {

/// "line 3, column 7" of a byte of the text, counted from 1.
std::string placeOf(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n');
    const std::size_t column = before.size() - (start == std::string_view::npos ? 0 : start + 1);
    return "line " + std::to_string(line) + ", column " +
           std::to_string(std::max<std::size_t>(column, 1));
}

/// One step of a JSON pointer (RFC 6901).
std::string escaped(const std::string& name) {
    std::string text;
    for (const char c : name) {
        text += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return text;
}

/// Watches a parse for what the tree would hide: depth, and a member given twice.
struct Watch {
    std::vector<std::set<std::string>> members;
    std::string twice;
    bool deep = false;

    bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
        using Event = Json::parse_event_t;
        deep = deep || depth > kMaxDepth;
        if (deep) {
            return false; // what is left out has no end event
        }
        if (event == Event::object_start) {
            members.emplace_back();
        } else if (event == Event::object_end) {
            members.pop_back();
        } else if (event == Event::key && twice.empty()) {
            const auto name = parsed.get<std::string>();
            twice = members.back().insert(name).second ? twice : name;
        }
        return true;
    }
};

} // namespace

core::Result<Tree> parseTree(std::string_view text) {
    if (text.size() > kMaxTextBytes) {
        return core::refused("a lighting document has at most 64 MiB");
    }
    const core::SharedMemory shared;
    Watch watch;
    try {
        Json tree = Json::parse(text.begin(), text.end(),
                                [&](int depth, Json::parse_event_t event, Json& parsed) {
                                    return watch(depth, event, parsed);
                                });
        if (watch.deep) {
            return core::refused("the document is nested deeper than 64 levels");
        }
        if (!watch.twice.empty()) {
            return core::refused("an object has the member \"" + watch.twice + "\" twice");
        }
        return Tree(std::move(tree));
    } catch (const Json::parse_error& error) {
        return core::refused("this is not JSON, or its end is missing", placeOf(text, error.byte));
    } catch (const Json::exception&) {
        return core::refused("a number is beyond what a double holds");
    }
}

void Reader::refuse(const std::string& what) const {
    if (!refusal_) {
        refusal_ = core::refused(what, pointer_.empty() ? "/" : pointer_);
    }
}

bool Reader::isObject() const {
    if (!value_.is_object()) {
        refuse("an object is needed");
    }
    return value_.is_object();
}

std::optional<Reader> Reader::member(const std::string& name) const {
    if (!value_.is_object()) {
        return std::nullopt;
    }
    const auto found = value_.find(name);
    if (found == value_.end()) {
        return std::nullopt;
    }
    return Reader(*found, pointer_ + "/" + escaped(name), refusal_);
}

std::optional<Reader> Reader::needed(const char* name) const {
    auto found = member(name);
    if (!found) {
        refuse(std::string("\"") + name + "\" is missing");
    }
    return found;
}

std::string Reader::unknown(std::initializer_list<const char*> known) const {
    const core::SharedMemory shared; // as a Tree
    Json rest = Json::object();
    for (const auto& [name, value] : value_.items()) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            rest[name] = value;
        }
    }
    return rest.empty() ? std::string() : rest.dump();
}

double Reader::number() const {
    if (!value_.is_number()) {
        refuse("a number is needed");
        return 0.0;
    }
    return value_.get<double>();
}

double Reader::numberIn(double least, double greatest, const char* rule) const {
    const double value = number();
    if (!(value >= least && value <= greatest)) {
        refuse(rule);
        return least;
    }
    return value;
}

bool Reader::boolean() const {
    if (!value_.is_boolean()) {
        refuse("true or false is needed");
        return false;
    }
    return value_.get<bool>();
}

std::string Reader::text() const {
    if (!value_.is_string()) {
        refuse("a text is needed");
        return {};
    }
    return value_.get<std::string>();
}

glm::dvec3 Reader::vector() const {
    glm::dvec3 values(0.0);
    int count = 0;
    forEach([&](const Reader& element) {
        if (count < 3) {
            values[count] = element.number();
        }
        ++count;
    });
    if (count != 3) {
        refuse("three numbers are needed");
    }
    return values;
}

std::size_t Reader::word(std::initializer_list<const char*> words) const {
    const std::string given = text();
    std::string list;
    std::size_t place = 0;
    for (const char* each : words) {
        if (given == each) {
            return place;
        }
        list += (list.empty() ? "" : ", ") + std::string(each);
        ++place;
    }
    refuse("\"" + given.substr(0, 40) + "\" is none of " + list);
    return 0;
}

} // namespace lodestar::document
