#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace hagen::base {

/// A JSON value. Objects keep their keys in insertion order.
///
///     Json report{{"runs", 12}, {"names", {"a", "b"}}};
///     report["mean"] = Json();  // null
///     report.dump(2);
///
/// nlohmann's library parses and prints; only Json.cpp includes it, because it is slow to compile.
class Json {
 public:
    Json();  ///< null
    Json(std::nullptr_t);
    Json(std::string text);  ///< should be UTF-8, see dump()
    Json(const char* text);
    /// A boolean, integer or floating-point number; numbers that are not finite become null.
    template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
    Json(Number number) : Json(Scalar(widest(number))) {}
    /// An array of a container's items.
    template <class Items,
              class = std::enable_if_t<!std::is_convertible_v<const Items&, std::string> &&
                                       std::is_constructible_v<Json, typename Items::value_type>>>
    Json(const Items& items) : Json(array()) {
        for (const auto& item : items) push_back(Json(item));
    }
    template <class Item>
    Json(const std::map<std::string, Item>& members) : Json(object()) {
        for (const auto& [key, member] : members) (*this)[key] = Json(member);
    }
    /// An object if all items are pairs that begin with a string, otherwise an array.
    Json(std::initializer_list<Json> items);

    Json(const Json& other);
    Json(Json&& other) noexcept;
    Json& operator=(const Json& other);
    Json& operator=(Json&& other) noexcept;
    ~Json();

    static Json object();
    static Json array(std::initializer_list<Json> items = {});
    /// Parses a text. Throws std::runtime_error: "is no JSON: line 3, column 7: ...", that it ends
    /// too early, or that more than 64 arrays and objects are within each other.
    static Json parse(const std::string& text);

    /// The value of a key; a new key gets null. Null becomes an object; any other type throws
    /// std::logic_error.
    Json& operator[](const std::string& key);
    /// Appends to an array. Null becomes an array; any other type throws std::logic_error.
    void push_back(Json item);

    // Reading. A missing value or one of another type throws std::runtime_error, saying what is
    // expected.
    bool isObject() const { return std::holds_alternative<Object>(value_); }
    bool isArray() const { return std::holds_alternative<Array>(value_); }
    bool isNumber() const;
    bool isText() const { return std::holds_alternative<std::string>(value_); }
    const Json* find(const std::string& key) const;  ///< nullptr: no object, or no such key
    const Json& at(const std::string& key) const;
    const Json& at(std::size_t index) const;
    const std::vector<Json>& items() const;                            ///< of an array
    const std::vector<std::pair<std::string, Json>>& members() const;  ///< of an object
    const std::string& text() const;
    double number() const;
    std::uint64_t count() const;  ///< an integer of at least 0
    std::vector<double> numbers() const;
    std::vector<std::string> texts() const;

    /// How to handle text that is not valid UTF-8, such as file names.
    enum class NotUtf8 { Throw, Replace };

    /// Returns JSON text on one line, or indented by `indent` spaces. Text that is not UTF-8 throws
    /// std::exception, or its invalid bytes become U+FFFD.
    std::string dump(int indent = -1, NotUtf8 not_utf8 = NotUtf8::Throw) const;

 private:
    using Array = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;
    using Scalar = std::variant<bool, std::int64_t, std::uint64_t, double>;
    struct Text;

    explicit Json(Scalar number);

    template <class Number>
    static constexpr auto widest(Number number) {
        if constexpr (std::is_same_v<Number, bool>) {
            return number;
        } else if constexpr (std::is_floating_point_v<Number>) {
            return static_cast<double>(number);
        } else if constexpr (std::is_signed_v<Number>) {
            return static_cast<std::int64_t>(number);
        } else {
            return static_cast<std::uint64_t>(number);
        }
    }

    std::variant<std::nullptr_t, Scalar, std::string, Array, Object> value_;
};

}  // namespace hagen::base
