// SPDX-License-Identifier: MIT
#include "model/command_text.h"

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <type_traits>

#include "model/command_fields.h"
#include "model/part_text.h"

namespace lodestar::model {
namespace {

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

/// What has members of its own in command_fields.h.
template <class T>
constexpr bool kDescribed = std::is_same_v<T, StopMove> || std::is_same_v<T, Brush>;

/// Hears a command's name and nothing else.
struct Namer {
    std::string_view name;
    Namer& command(const char* text) {
        name = text;
        return *this;
    }
    template <class T>
    Namer& operator()(const char*, T&) {
        return *this;
    }
    template <class T>
    Namer& given(const char*, T&) {
        return *this;
    }
    template <class T>
    Namer& degrees(const char*, T&) {
        return *this;
    }
    template <class T>
    Namer& exponent(const char*, T&) {
        return *this;
    }
};

/// Members into an object.
class Writer {
public:
    explicit Writer(const Identities& ids) : ids_(ids) {}

    Writer& command(const char* name) {
        object["do"] = name;
        return *this;
    }
    template <class T>
    Writer& operator()(const char* name, T& value) {
        if constexpr (IsOptional<T>::value) {
            if (value) {
                object[name] = json(*value);
            }
        } else {
            object[name] = json(value);
        }
        return *this;
    }
    template <class T>
    Writer& given(const char* name, T& value) {
        return (*this)(name, value);
    }
    Writer& degrees(const char* name, const std::optional<double>& radians) {
        if (radians) {
            object[name] = jsonOfAngle(*radians);
        }
        return *this;
    }
    Writer& exponent(const char* name, const std::optional<double>& value) {
        if (value) {
            object[name] = std::isinf(*value) ? Json("mirror") : Json(*value);
        }
        return *this;
    }

    Json object = Json::object();
    bool missing = false; ///< a part that is named is not there

private:
    template <class T>
    Json json(T& value) {
        if constexpr (std::is_same_v<T, Id>) {
            const std::string pointer = pointerOf(ids_, value);
            missing = missing || pointer.empty();
            return pointer;
        } else if constexpr (IsOptional<T>::value) {
            return value ? json(*value) : Json();
        } else if constexpr (kDescribed<T>) {
            Writer within(ids_);
            describe(within, value);
            missing = missing || within.missing;
            return std::move(within.object);
        } else {
            return jsonOf(value);
        }
    }
    template <class T>
    Json json(std::vector<T>& values) {
        if constexpr (std::is_same_v<T, document::Stop> || std::is_same_v<T, document::Light>) {
            return jsonOf(values);
        } else {
            Json list = Json::array();
            for (T& value : values) {
                list.push_back(json(value));
            }
            return list;
        }
    }

    const Identities& ids_;
};

/// Members out of an object, to the first that breaks a rule.
class Reader {
public:
    Reader(const Json& object, std::string pointer, const Identities& ids)
        : object_(object), pointer_(std::move(pointer)), ids_(ids) {}

    Reader& command(const char*) {
        known_.insert("do");
        return *this;
    }
    template <class T>
    Reader& operator()(const char* name, T& value) {
        return member(name, value, !IsOptional<T>::value);
    }
    template <class T>
    Reader& given(const char* name, T& value) {
        return member(name, value, false);
    }
    Reader& degrees(const char* name, std::optional<double>& radians) {
        known_.insert(name);
        if (object_.contains(name) && !error_) {
            double read = 0.0;
            take(readAngle(object_[name], read), pointer_ + "/" + name);
            radians = read;
        }
        return *this;
    }
    Reader& exponent(const char* name, std::optional<double>& value) {
        if (object_.contains(name) && object_[name] == "mirror") {
            known_.insert(name);
            value = std::numeric_limits<double>::infinity();
            return *this;
        }
        return member(name, value, false);
    }

    /// What was wrong; also that there is a member that the command does not have.
    [[nodiscard]] std::optional<core::Error> end() {
        for (const auto& [name, value] : object_.items()) {
            if (!error_ && !known_.contains(name)) {
                refuse("there is no such member", pointer_ + "/" + name);
            }
        }
        return error_;
    }

private:
    template <class T>
    Reader& member(const char* name, T& value, bool needed) {
        known_.insert(name);
        if (error_) {
            return *this;
        }
        if (object_.contains(name)) {
            read(object_[name], value, pointer_ + "/" + name);
        } else if (needed) {
            refuse(std::string("\"").append(name) + "\" is needed", pointer_);
        }
        return *this;
    }
    template <class T>
    void read(const Json& json, std::optional<T>& value, const std::string& at) {
        value.emplace();
        if constexpr (IsOptional<T>::value) { // null takes a value away
            if (json.is_null()) {
                return;
            }
        }
        read(json, *value, at);
    }
    template <class T>
    void read(const Json& json, std::vector<T>& values, const std::string& at) {
        if constexpr (std::is_same_v<T, document::Stop> || std::is_same_v<T, document::Light>) {
            take(readPart(json, values), at);
        } else {
            if (!json.is_array()) {
                return refuse("a list is needed", at);
            }
            for (std::size_t i = 0; i < json.size() && !error_; ++i) {
                values.emplace_back();
                read(json[i], values.back(), at + "/" + std::to_string(i));
            }
        }
    }
    template <class T>
    void read(const Json& json, T& value, const std::string& at) {
        if constexpr (std::is_same_v<T, Id>) {
            value = json.is_string() ? partAt(ids_, json.get<std::string>()) : Id::None;
            if (value == Id::None) {
                refuse("no light, key, stop or probe is there", at);
            }
        } else if constexpr (kDescribed<T>) {
            if (!json.is_object()) {
                return refuse("an object is needed", at);
            }
            Reader within(json, at, ids_);
            describe(within, value);
            error_ = within.end();
        } else {
            take(readPart(json, value), at);
        }
    }
    /// A part's own error, whose place is below `at`.
    void take(const core::Result<void>& part, const std::string& at) {
        if (!part) {
            refuse(part.error().what, at + part.error().where);
        }
    }
    void refuse(std::string what, std::string at) {
        error_ = core::refused(std::move(what), std::move(at));
    }

    const Json& object_;
    std::string pointer_;
    const Identities& ids_;
    std::set<std::string> known_;
    std::optional<core::Error> error_;
};

/// A command of each type, as it is when nothing is given.
template <std::size_t... Types>
std::vector<Command> eachType(std::index_sequence<Types...>) {
    return {Command(std::in_place_index<Types>)...};
}
std::vector<Command> eachType() {
    return eachType(std::make_index_sequence<std::variant_size_v<Command>>());
}

std::string_view nameIn(Command command) {
    Namer namer;
    std::visit([&](auto& each) { describe(namer, each); }, command);
    return namer.name;
}

/// A line as an object. @errors InputRefused
core::Result<Json> objectOf(std::string_view line) {
    bool deep = false;
    const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
        deep = deep || depth > document::kMaxDepth;
        return depth <= document::kMaxDepth;
    };
    Json object = Json::parse(line, shallow, false);
    if (deep) {
        return core::refused("is nested too deep");
    }
    if (object.is_discarded() || !object.is_object()) {
        return core::refused("is no JSON object");
    }
    if (!object.contains("do") || !object["do"].is_string()) {
        return core::refused("\"do\" must name a command", "/do");
    }
    return object;
}

core::Result<Command> commandOf(const Json& object, const Identities& ids) {
    const auto name = object["do"].get<std::string>();
    for (Command& command : eachType()) {
        if (nameIn(command) == name) {
            Reader reader(object, {}, ids);
            std::visit([&](auto& each) { describe(reader, each); }, command);
            if (const auto error = reader.end()) {
                return *error;
            }
            return std::move(command);
        }
    }
    return core::refused("there is no command \"" + name + "\"", "/do");
}

core::Result<void> runLine(std::string_view line, Model& model) {
    const auto object = objectOf(line);
    if (!object) {
        return object.error();
    }
    const auto name = (*object)["do"].get<std::string>();
    if (name == "Undo" || name == "Redo") {
        if (object->size() > 1) {
            return core::refused(name + " has no members");
        }
        const bool done = name == "Undo" ? model.undo() : model.redo();
        return done ? core::Result<void>() : core::refused("there is no step for " + name);
    }
    const auto command = commandOf(*object, model.ids());
    if (!command) {
        return command.error();
    }
    const auto executed = model.execute(*command);
    return executed ? core::Result<void>() : executed.error();
}

} // namespace

core::Result<std::string> writeCommand(const Command& command, const Model& model) {
    return writeCommand(command, model.ids());
}

core::Result<std::string> writeCommand(const Command& command, const Identities& ids) {
    Command copy = command;
    Writer writer(ids);
    std::visit([&](auto& each) { describe(writer, each); }, copy);
    if (writer.missing) {
        return core::refused("the command names a part that the document does not have");
    }
    std::string line = writer.object.dump(-1, ' ', false, Json::error_handler_t::replace);
    const auto object = objectOf(line);
    const auto read = object ? commandOf(*object, ids) : object.error();
    return read ? core::Result<std::string>(std::move(line)) : read.error();
}

core::Result<Command> readCommand(std::string_view line, const Model& model) {
    const auto object = objectOf(line);
    return object ? commandOf(*object, model.ids()) : object.error();
}

core::Result<std::size_t> runScript(std::string_view text, Model& model) {
    std::size_t commands = 0;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string_view::npos || line[first] == '#') {
            continue;
        }
        if (auto done = runLine(line, model); !done) {
            core::Error error = done.error();
            error.where =
                "line " + std::to_string(number) + (error.where.empty() ? "" : ", " + error.where);
            return error;
        }
        ++commands;
    }
    return commands;
}

std::string writeHistory(const Model& model) {
    std::string text;
    model.visitDone([&](std::string_view step, const Command& command, const Identities& found,
                        const document::Document& left) {
        auto line = writeCommand(command, found);
        if (!line) {
            line = writeCommand(ReplaceDocument{left}, found);
        }
        text += "# " + std::string(step) + "\n" + (line ? *line : std::string()) + "\n";
    });
    return text;
}

std::vector<std::string_view> commandNames() {
    std::vector<std::string_view> names;
    for (const Command& command : eachType()) {
        names.push_back(nameIn(command));
    }
    return names;
}

} // namespace lodestar::model
