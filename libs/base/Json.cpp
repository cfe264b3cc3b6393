#include <hagen/base/Json.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hagen::base {

/// Converts to nlohmann's values and back.
struct Json::Text {
    using Value = nlohmann::ordered_json;

    static Value valueOf(const Json& json) {
        if (const auto* number = std::get_if<Scalar>(&json.value_)) {
            return std::visit([](auto value) { return Value(value); }, *number);
        }
        if (const auto* text = std::get_if<std::string>(&json.value_)) return Value(*text);
        if (const auto* items = std::get_if<Array>(&json.value_)) {
            Value::array_t values;
            values.reserve(items->size());
            for (const Json& item : *items) values.push_back(valueOf(item));
            return Value(std::move(values));
        }
        if (const auto* members = std::get_if<Object>(&json.value_)) {
            Value object = Value::object();
            for (const auto& [key, member] : *members) object[key] = valueOf(member);
            return object;
        }
        return Value();
    }

    static Json jsonOf(const Value& value) {
        if (value.is_boolean()) return Json(value.get<bool>());
        if (value.is_number_unsigned()) return Json(value.get<std::uint64_t>());
        if (value.is_number_integer()) return Json(value.get<std::int64_t>());
        if (value.is_number_float()) return Json(value.get<double>());
        if (value.is_string()) return Json(value.get<std::string>());
        Json json;
        if (value.is_array()) {
            json.value_ = Array();
            for (const Value& item : value) json.push_back(jsonOf(item));
        }
        if (value.is_object()) {
            json.value_ = Object();
            for (const auto& [key, member] : value.items()) json[key] = jsonOf(member);
        }
        return json;
    }
};

Json::Json() = default;
Json::Json(std::nullptr_t) {}
Json::Json(std::string text) : value_(std::move(text)) {}
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(Scalar number) : value_(number) {}
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<Json> items) {
    const bool is_object = std::all_of(items.begin(), items.end(), [](const Json& item) {
        const auto* pair = std::get_if<Array>(&item.value_);
        return pair != nullptr && pair->size() == 2 &&
               std::holds_alternative<std::string>(pair->front().value_);
    });
    if (!is_object) {
        value_ = Array(items);
        return;
    }
    value_ = Object();
    for (const Json& item : items) {
        const Array& pair = std::get<Array>(item.value_);
        (*this)[std::get<std::string>(pair[0].value_)] = pair[1];
    }
}

Json Json::object() {
    Json json;
    json.value_ = Object();
    return json;
}

Json Json::array(std::initializer_list<Json> items) {
    Json json;
    json.value_ = Array(items);
    return json;
}

namespace {

/// What the parser's words for what it expects mean to a user; empty if it says nothing useful.
std::string expectedBy(const std::string& parser) {
    const std::size_t at = parser.rfind("expected ");
    // "unexpected ..." is not what is expected.
    if (at == std::string::npos || (at > 0 && parser[at - 1] != ' ')) return "";
    const std::string token = parser.substr(at + 9);
    if (token == "string literal") return "a name in quotes";
    if (token == "']'") return "',' or ']'";
    if (token == "'}'") return "',' or '}'";
    if (token == "end of input") return "the end of the text";
    return token == "'[', '{', or a literal" ? "a value" : token;
}

/// The end of a line, as far as it can be printed.
std::string printable(const std::string& line) {
    constexpr std::size_t kMost = 20;
    std::string text = line.size() > kMost ? "..." + line.substr(line.size() - kMost) : line;
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
    return text;
}

/// Where and why a text is no JSON. The parser has read `bytes` of it.
std::string faultOf(const std::string& text, std::size_t bytes, const std::string& parser) {
    if (bytes > text.size() || parser.find("end of input; expected") != std::string::npos) {
        return "it ends too early; is it cut?";
    }
    const std::string before = text.substr(0, bytes);
    const std::size_t line_start = before.rfind('\n', bytes < 2 ? 0 : bytes - 2) + 1;
    const std::string line = before.substr(line_start, before.find('\n', line_start) - line_start);
    const auto number = 1 + std::count(before.begin(), before.begin() + line_start, '\n');
    std::string what = "unexpected text";
    if (parser.find("missing closing quote") != std::string::npos) what = "text without its \"";
    if (parser.find("control character") != std::string::npos) {
        what = "text that does not end in its line";
    }
    if (parser.find("UTF-8") != std::string::npos) what = "a byte that is no UTF-8";
    const std::string expected = expectedBy(parser);
    return "line " + std::to_string(number) + ", column " + std::to_string(line.size()) + ": " +
           what + " at '" + printable(line) + "'" +
           (expected.empty() ? "" : "; " + expected + " is expected");
}

}  // namespace

Json Json::parse(const std::string& text) {
    try {
        return Text::jsonOf(Text::Value::parse(text));
    } catch (const nlohmann::json::parse_error& e) {
        throw std::runtime_error("is no JSON: " + faultOf(text, e.byte, e.what()));
    } catch (const nlohmann::json::exception& e) {
        const std::string what = e.what();  // "[json.exception...] what"
        const std::size_t end = what.find("] ");
        throw std::runtime_error("is no JSON: " +
                                 what.substr(end == std::string::npos ? 0 : end + 2));
    }
}

Json& Json::operator[](const std::string& key) {
    if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object();
    auto* members = std::get_if<Object>(&value_);
    if (members == nullptr) throw std::logic_error("not a JSON object, so it has no key " + key);
    for (auto& [known, member] : *members) {
        if (known == key) return member;
    }
    return members->emplace_back(key, Json()).second;
}

void Json::push_back(Json item) {
    if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Array();
    auto* items = std::get_if<Array>(&value_);
    if (items == nullptr) throw std::logic_error("not a JSON array");
    items->push_back(std::move(item));
}

bool Json::isNumber() const {
    const auto* scalar = std::get_if<Scalar>(&value_);
    return scalar != nullptr && !std::holds_alternative<bool>(*scalar);
}

const Json* Json::find(const std::string& key) const {
    const auto* members = std::get_if<Object>(&value_);
    if (members == nullptr) return nullptr;
    for (const auto& [known, member] : *members) {
        if (known == key) return &member;
    }
    return nullptr;
}

const Json& Json::at(const std::string& key) const {
    const Json* member = find(key);
    if (member == nullptr) throw std::runtime_error("there is no key '" + key + "'");
    return *member;
}

const Json& Json::at(std::size_t index) const {
    if (index >= items().size()) {
        throw std::runtime_error("expected at least " + std::to_string(index + 1) +
                                 " items, not: " + dump());
    }
    return items()[index];
}

const std::vector<Json>& Json::items() const {
    if (!isArray()) throw std::runtime_error("expected an array, not: " + dump());
    return std::get<Array>(value_);
}

const std::vector<std::pair<std::string, Json>>& Json::members() const {
    if (!isObject()) throw std::runtime_error("expected an object, not: " + dump());
    return std::get<Object>(value_);
}

const std::string& Json::text() const {
    if (!isText()) throw std::runtime_error("expected text, not: " + dump());
    return std::get<std::string>(value_);
}

double Json::number() const {
    if (!isNumber()) throw std::runtime_error("expected a number, not: " + dump());
    return std::visit([](auto number) { return static_cast<double>(number); },
                      std::get<Scalar>(value_));
}

std::uint64_t Json::count() const {
    const auto* scalar = std::get_if<Scalar>(&value_);
    const auto* count = scalar != nullptr ? std::get_if<std::uint64_t>(scalar) : nullptr;
    if (count == nullptr) {
        throw std::runtime_error("expected an integer of at least 0, not: " + dump());
    }
    return *count;
}

std::vector<double> Json::numbers() const {
    std::vector<double> numbers;
    for (const Json& item : items()) {
        if (!item.isNumber()) {
            throw std::runtime_error("item " + std::to_string(numbers.size() + 1) + " of " +
                                     std::to_string(items().size()) +
                                     ": expected a number, not: " + item.dump());
        }
        numbers.push_back(item.number());
    }
    return numbers;
}

std::vector<std::string> Json::texts() const {
    std::vector<std::string> texts;
    for (const Json& item : items()) texts.push_back(item.text());
    return texts;
}

std::string Json::dump(int indent, NotUtf8 not_utf8) const {
    const auto handler = not_utf8 == NotUtf8::Replace ? Text::Value::error_handler_t::replace
                                                      : Text::Value::error_handler_t::strict;
    return Text::valueOf(*this).dump(indent, ' ', false, handler);
}

}  // namespace hagen::base
