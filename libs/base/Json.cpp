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

Json Json::parse(const std::string& text) { return Text::jsonOf(Text::Value::parse(text)); }

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

std::string Json::dump(int indent, NotUtf8 not_utf8) const {
    const auto handler = not_utf8 == NotUtf8::Replace ? Text::Value::error_handler_t::replace
                                                      : Text::Value::error_handler_t::strict;
    return Text::valueOf(*this).dump(indent, ' ', false, handler);
}

}  // namespace hagen::base
