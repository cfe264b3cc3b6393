#include <hagen/base/NumberText.h>

#include <algorithm>
#include <map>

#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::NumberType;
using observations::PointField;

/// A value of the header: a Python literal.
struct Literal {
    enum class Kind { Text, Number, Bool, List, Dict } kind = Kind::Number;
    std::string text;
    std::uint64_t number = 0;    ///< or 1 for True
    std::vector<Literal> items;  ///< of a list or tuple; of a dict: keys and values by turns
};

/// Parses the literals that NumPy writes: nothing else of Python.
class LiteralParser {
 public:
    LiteralParser(const std::filesystem::path& file, std::string_view text)
        : file_(file), text_(text) {}

    Literal parse(int depth = 0) {
        constexpr int kDeepest = 16;
        skipBlanks();
        if (at_ >= text_.size() || depth > kDeepest) fail();
        const char c = text_[at_];
        if (c == '\'' || c == '"') return parseText(c);
        if (c == '(' || c == '[' || c == '{') return parseItems(c, depth);
        if (take("True")) return truth(1);
        if (take("False")) return truth(0);
        return parseNumber();
    }

 private:
    [[noreturn]] void fail() const {
        throw BrokenCloud(file_.string() + ": its NPY header is not understood at character " +
                          std::to_string(at_));
    }
    void skipBlanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    }
    bool take(std::string_view word) {
        if (text_.substr(at_, word.size()) != word) return false;
        at_ += word.size();
        return true;
    }
    static Literal truth(std::uint64_t number) {
        Literal literal;
        literal.kind = Literal::Kind::Bool;
        literal.number = number;
        return literal;
    }
    Literal parseText(char quote) {
        Literal literal;
        literal.kind = Literal::Kind::Text;
        const std::size_t end = text_.find(quote, at_ + 1);
        if (end == std::string_view::npos) fail();
        literal.text = std::string(text_.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
        return literal;
    }
    Literal parseNumber() {
        const std::size_t start = at_;
        while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') ++at_;
        const auto number = base::numberFrom<std::uint64_t>(text_.substr(start, at_ - start));
        if (!number) fail();
        take("L");  // of old Pythons
        Literal literal;
        literal.number = *number;
        return literal;
    }
    Literal parseItems(char opening, int depth) {
        const char closing = opening == '(' ? ')' : opening == '[' ? ']' : '}';
        Literal literal;
        literal.kind = opening == '{' ? Literal::Kind::Dict : Literal::Kind::List;
        ++at_;
        while (true) {
            skipBlanks();
            if (at_ < text_.size() && text_[at_] == closing) break;
            literal.items.push_back(parse(depth + 1));
            skipBlanks();
            if (opening == '{' && literal.items.size() % 2 == 1) {
                if (!take(":")) fail();
                continue;
            }
            if (!take(",")) {
                skipBlanks();
                if (at_ >= text_.size() || text_[at_] != closing) fail();
            }
        }
        if (opening == '{' && literal.items.size() % 2 == 1) fail();
        ++at_;
        return literal;
    }

    const std::filesystem::path& file_;
    std::string_view text_;
    std::size_t at_ = 0;
};

const Literal& valueOf(const std::filesystem::path& file, const Literal& header, const char* key,
                       Literal::Kind kind, bool is_any_kind = false) {
    for (std::size_t i = 0; i + 1 < header.items.size(); i += 2) {
        if (header.items[i].text != key) continue;
        if (!is_any_kind && header.items[i + 1].kind != kind) break;
        return header.items[i + 1];
    }
    throw BrokenCloud(file.string() + ": its NPY header has no sound '" + key + "'");
}

/// A type such as "<f4".
struct ItemType {
    std::optional<NumberType> type;  ///< none: no plain number
    std::size_t bytes = 0;
    char order = '|';
};

ItemType itemTypeOf(const std::filesystem::path& file, const std::string& text) {
    static const std::map<std::string, NumberType> kTypes{
        {"i1", NumberType::Int8},    {"u1", NumberType::UInt8},  {"b1", NumberType::UInt8},
        {"i2", NumberType::Int16},   {"u2", NumberType::UInt16}, {"i4", NumberType::Int32},
        {"u4", NumberType::UInt32},  {"i8", NumberType::Int64},  {"u8", NumberType::UInt64},
        {"f4", NumberType::Float32}, {"f8", NumberType::Float64}};
    const bool has_order = !text.empty() && std::string("<>|=").find(text[0]) != std::string::npos;
    const std::string name = text.substr(has_order ? 1 : 0);
    ItemType item;
    item.order = has_order && text[0] != '=' ? text[0] : '<';
    const auto known = kTypes.find(name);
    if (known != kTypes.end()) {
        item.type = known->second;
        item.bytes = bytesOf(known->second);
        if (item.bytes == 1) item.order = '|';
        return item;
    }
    // A type that is left out: its size follows its letter. M8[ns] has 8 bytes, U5 has 5 letters.
    const std::size_t end = std::min(name.find('['), name.size());
    const auto size =
        end > 1 ? base::numberFrom<std::uint32_t>(std::string_view(name).substr(1, end - 1))
                : std::nullopt;
    if (!size || name[0] == 'O') {
        throw BrokenCloud(file.string() + ": the type '" + text.substr(0, 40) +
                          "' of its numbers is not known");
    }
    item.bytes = name[0] == 'U' ? std::size_t{4} * *size : *size;
    item.order = '|';
    return item;
}

std::size_t productOf(const std::filesystem::path& file, const std::vector<Literal>& sizes,
                      std::size_t first, std::size_t last) {
    std::size_t product = 1;
    for (std::size_t i = first; i < last; ++i) {
        if (sizes[i].kind != Literal::Kind::Number ||
            __builtin_mul_overflow(product, sizes[i].number, &product)) {
            throw BrokenCloud(file.string() + ": the shape in its NPY header is absurd");
        }
    }
    return product;
}

/// Notes the byte order of numbers; they must have the same.
void takeOrder(const std::filesystem::path& file, char order, char& all) {
    if (order == '|') return;
    if (all != '|' && all != order) {
        throw BrokenCloud(file.string() + ": has numbers of both byte orders");
    }
    all = order;
}

/// The fields of a structured array.
void takeFields(const std::filesystem::path& file, const Literal& descr, CloudFile& cloud,
                char& order) {
    std::string left_out;
    for (const Literal& field : descr.items) {
        if (field.items.size() < 2 || field.items[0].kind == Literal::Kind::Number) {
            throw BrokenCloud(file.string() + ": its NPY header has no sound 'descr'");
        }
        // A field with a title is named by a pair.
        const Literal& title = field.items[0];
        const std::string name = title.kind == Literal::Kind::List && title.items.size() == 2
                                     ? title.items[1].text
                                     : title.text;
        std::size_t count = 1;
        if (field.items.size() > 2) {
            const Literal& shape = field.items[2];
            count = shape.kind == Literal::Kind::List
                        ? productOf(file, shape.items, 0, shape.items.size())
                        : shape.number;
        }
        if (field.items[1].kind != Literal::Kind::Text) {
            throw BrokenCloud(file.string() + ": its field '" + name +
                              "' has fields of its own, which are not read");
        }
        const ItemType item = itemTypeOf(file, field.items[1].text);
        if (item.type && !name.empty() && count > 0) {
            takeOrder(file, item.order, order);
            cloud.table.fields.push_back({name, *item.type, cloud.table.bytes_per_point, count});
        } else if (!name.empty()) {
            left_out += (left_out.empty() ? "" : ", ") + name;
        }
        std::size_t size = 0;
        if (__builtin_mul_overflow(count, item.bytes, &size) ||
            __builtin_add_overflow(cloud.table.bytes_per_point, size,
                                   &cloud.table.bytes_per_point)) {
            throw BrokenCloud(file.string() + ": the size of its field '" + name + "' is absurd");
        }
    }
    if (!left_out.empty()) {
        cloud.remarks.push_back("fields that are not plain numbers are not read: " + left_out);
    }
}

/// The columns of a plain array: x, y, z, intensity, field_4 and so on.
void takeColumns(const std::filesystem::path& file, const Literal& descr, std::size_t columns,
                 CloudFile& cloud, char& order) {
    constexpr std::size_t kMostColumns = 1024;
    const ItemType item = itemTypeOf(file, descr.text);
    if (!item.type) {
        throw BrokenCloud(file.string() + ": its numbers are '" + descr.text.substr(0, 40) +
                          "'; convert them, for example with .astype(numpy.float32)");
    }
    if (columns < 3 || columns > kMostColumns) {
        throw BrokenCloud(file.string() + ": has " + std::to_string(columns) +
                          " numbers per point: the array must be N x 3 or more (x, y, z, ...)");
    }
    takeOrder(file, item.order, order);
    for (std::size_t column = 0; column < columns; ++column) {
        const std::vector<std::string> kNames{"x", "y", "z", "intensity"};
        cloud.table.fields.push_back(
            {column < kNames.size() ? kNames[column] : "field_" + std::to_string(column),
             *item.type, column * item.bytes, 1});
    }
    cloud.table.bytes_per_point = columns * item.bytes;
}

/// Points as records, of an array that has one column after the other.
Bytes transposed(const Bytes& bytes, std::size_t points, std::size_t columns, std::size_t size) {
    Bytes records(bytes.size());
    for (std::size_t column = 0; column < columns; ++column) {
        for (std::size_t i = 0; i < points; ++i) {
            std::copy_n(bytes.data() + (column * points + i) * size, size,
                        records.data() + (i * columns + column) * size);
        }
    }
    return records;
}

}  // namespace

CloudFile readNpy(const std::filesystem::path& file, Bytes bytes) {
    constexpr std::size_t kVersion = 6, kLength = 8;
    const bool is_long = bytes.size() > kVersion && bytes[kVersion] >= 2;
    const std::size_t text_start = kLength + (is_long ? 4 : 2);
    if (bytes.size() < text_start)
        throw BrokenCloud(file.string() + ": ends within its NPY header");
    const std::size_t length =
        is_long ? numberAt<std::uint32_t>(bytes, kLength) : numberAt<std::uint16_t>(bytes, kLength);
    if (length > bytes.size() - text_start) {
        throw BrokenCloud(file.string() + ": ends within its NPY header");
    }
    const std::string text(reinterpret_cast<const char*>(bytes.data()) + text_start, length);
    const Literal header = LiteralParser(file, text).parse();
    using Kind = Literal::Kind;
    const Literal& descr = valueOf(file, header, "descr", Kind::Text, true);
    const Literal& shape = valueOf(file, header, "shape", Kind::List);
    const bool is_by_column = valueOf(file, header, "fortran_order", Kind::Bool).number != 0;

    CloudFile cloud;
    const bool is_plain = descr.kind == Kind::Text;
    const std::size_t dimensions = shape.items.size();
    if (is_plain && dimensions < 2) {
        throw BrokenCloud(file.string() + ": has " + std::to_string(dimensions) +
                          " dimensions: the array must be N x 3 or more (x, y, z, ...)");
    }
    const std::size_t point_dimensions = is_plain ? dimensions - 1 : dimensions;
    if (is_by_column && point_dimensions > 1) {
        throw BrokenCloud(file.string() +
                          ": is in Fortran order with several dimensions, which is not read; save "
                          "numpy.ascontiguousarray() of it");
    }
    cloud.table.points = productOf(file, shape.items, 0, point_dimensions);
    char order = '|';
    if (is_plain) {
        takeColumns(file, descr, productOf(file, shape.items, dimensions - 1, dimensions), cloud,
                    order);
    } else {
        takeFields(file, descr, cloud, order);
    }
    const std::size_t start = text_start + length;
    checkRoom(file, cloud.table.points, cloud.table.bytes_per_point, bytes.size() - start);
    const std::size_t size = cloud.table.points * cloud.table.bytes_per_point;
    cloud.remarks = [&] {
        auto remarks = cloud.remarks;
        for (std::string& rest : remarkOnRest(bytes.size() - start - size)) remarks.push_back(rest);
        return remarks;
    }();
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(start));
    bytes.resize(size);
    if (is_plain && is_by_column) {
        bytes = transposed(bytes, cloud.table.points, cloud.table.fields.size(),
                           bytesOf(cloud.table.fields[0].type));
    }
    cloud.table.is_big_endian = order == '>';
    cloud.table.bytes = std::move(bytes);
    return cloud;
}

}  // namespace hagen::recordings
