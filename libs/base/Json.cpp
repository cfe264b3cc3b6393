#include <hagen/base/Json.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hagen::base {

// Only scalars become values of nlohmann's: when one of its objects or arrays ends, it allocates,
// and so ends the program if memory runs out.
using Value = nlohmann::ordered_json;

/// Writes values as text; its Builder reads them.
struct Json::Text {
    class Builder;

    const int indent;  ///< spaces per level; negative: one line
    const Value::error_handler_t not_utf8;
    std::string text;

    void write(const Json& json, int depth) {
        if (const auto* items = std::get_if<Array>(&json.value_)) {
            writeAll(*items, '[', ']', depth, [&](const Json& item) { write(item, depth + 1); });
        } else if (const auto* members = std::get_if<Object>(&json.value_)) {
            writeAll(*members, '{', '}', depth, [&](const auto& member) {
                write(Value(member.first));
                text += indent < 0 ? ":" : ": ";
                write(member.second, depth + 1);
            });
        } else if (const auto* number = std::get_if<Scalar>(&json.value_)) {
            std::visit([&](auto value) { write(Value(value)); }, *number);
        } else if (const auto* words = std::get_if<std::string>(&json.value_)) {
            write(Value(*words));
        } else {
            write(Value());
        }
    }

 private:
    void write(const Value& scalar) { text += scalar.dump(-1, ' ', false, not_utf8); }
    void breakLine(int depth) {
        if (indent < 0) return;
        text += '\n';
        text.append(static_cast<std::size_t>(indent * depth), ' ');
    }
    template <class Parts, class WritePart>
    void writeAll(const Parts& parts, char open, char close, int depth,
                  const WritePart& writePart) {
        text += open;
        bool is_first = true;
        for (const auto& part : parts) {
            if (!is_first) text += ',';
            is_first = false;
            breakLine(depth + 1);
            writePart(part);
        }
        if (!is_first) breakLine(depth);
        text += close;
    }
};

/// Makes a value of what the parser meets.
class Json::Text::Builder : public nlohmann::json_sax<Value> {
 public:
    bool null() override { return add(Json()); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(std::int64_t value) override { return add(value); }
    bool number_unsigned(std::uint64_t value) override { return add(value); }
    bool number_float(double value, const std::string&) override { return add(value); }
    bool string(std::string& text) override { return add(std::move(text)); }
    bool binary(Value::binary_t&) override { return false; }  // JSON has none
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool key(std::string& key) override {
        member_ = &open_.back().member(key);
        return true;
    }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override {
        is_syntax_error_ = dynamic_cast<const nlohmann::detail::parse_error*>(&error) != nullptr;
        position_ = position;
        why_ = error.what();
        return false;
    }

    Json root;
    bool is_syntax_error_ = false;
    std::size_t position_ = 0;  ///< bytes read when it was met
    std::string why_;
    bool is_too_deep_ = false;
    static constexpr std::size_t kDeepest = 64;

 private:
    /// An object or array whose end was not met yet.
    struct Open {
        Json* value;
        std::map<std::string, std::size_t> index;  ///< of the keys of a large object

        /// Looking through the keys for each new one takes the square of their number.
        Json& member(const std::string& key) {
            constexpr std::size_t kFew = 32;
            auto& members = std::get<Object>(value->value_);
            if (members.size() < kFew) return (*value)[key];
            if (index.empty()) {
                for (std::size_t i = 0; i < kFew; ++i) index.emplace(members[i].first, i);
            }
            const auto [known, is_new] = index.emplace(key, members.size());
            return is_new ? members.emplace_back(key, Json()).second
                          : members[known->second].second;
        }
    };

    /// Where the next value belongs.
    Json& place() {
        if (open_.empty()) return root;
        if (!open_.back().value->isArray()) return *member_;
        auto& items = std::get<Array>(open_.back().value->value_);
        return items.emplace_back();
    }
    bool add(Json value) {
        place() = std::move(value);
        return true;
    }
    /// Who writes, copies or destroys a value calls itself for each level.
    bool open(Json value) {
        is_too_deep_ = open_.size() >= kDeepest;
        if (is_too_deep_) return false;
        Json& at = place();
        at = std::move(value);
        open_.push_back({&at, {}});
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    std::vector<Open> open_;  ///< from the outermost
    Json* member_ = nullptr;  ///< of the object that is open
};

Json::Json() = default;
Json::Json(std::nullptr_t) {}
Json::Json(std::string text) : value_(std::move(text)) {}
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(Scalar number) : value_(number) {}
// Where a copy throws, libstdc++'s variant of such types ends what was not begun (GCC 12): only
// moves are left to it.
Json::Json(const Json& other) {
    std::visit(
        [this](const auto& value) {
            auto copy = value;
            value_ = std::move(copy);
        },
        other.value_);
}
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) {
    if (this != &other) *this = Json(other);
    return *this;
}
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
    Text::Builder builder;
    if (Value::sax_parse(text, &builder)) return std::move(builder.root);
    if (builder.is_too_deep_) {
        throw std::runtime_error("is nested too deeply: more than " +
                                 std::to_string(Text::Builder::kDeepest) +
                                 " lists and objects within each other");
    }
    if (builder.is_syntax_error_) {
        throw std::runtime_error("is no JSON: " + faultOf(text, builder.position_, builder.why_));
    }
    const std::size_t end = builder.why_.find("] ");  // "[json.exception...] what"
    throw std::runtime_error("is no JSON: " +
                             builder.why_.substr(end == std::string::npos ? 0 : end + 2));
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
    Text written{indent,
                 not_utf8 == NotUtf8::Replace ? Value::error_handler_t::replace
                                              : Value::error_handler_t::strict,
                 {}};
    written.write(*this, 0);
    return std::move(written.text);
}

}  // namespace hagen::base
