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

/// A JSON value. Objects keep their keys in the order in which they were set.
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
    /// A truth value, an integer, or a floating-point number; not finite is written as null.
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
    /// An object, if all items are pairs that begin with a text, else an array.
    Json(std::initializer_list<Json> items);

    Json(const Json& other);
    Json(Json&& other) noexcept;
    Json& operator=(const Json& other);
    Json& operator=(Json&& other) noexcept;
    ~Json();

    static Json object();
    static Json array(std::initializer_list<Json> items = {});
    /// Parses a text. Throws std::runtime_error, saying where it is not JSON.
    static Json parse(const std::string& text);

    /// The value of a key; null is set for a new one. A null becomes an object; of anything else
    /// but objects it throws std::logic_error.
    Json& operator[](const std::string& key);
    /// Appends to an array. A null becomes one; anything else throws std::logic_error.
    void push_back(Json item);

    // Reading. What is missing or of another type throws std::runtime_error, saying what is
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

    /// What to do about text that is not UTF-8, as file names may be.
    enum class NotUtf8 { Throw, Replace };

    /// As text: on one line, or indented by so many spaces. Throws std::exception for text that is
    /// not UTF-8, or replaces its bytes by U+FFFD.
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
