#include <yaml-cpp/yaml.h>
#include "base/NumberText.h"

#include <algorithm>
#include <map>

#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::NumberType;

constexpr std::size_t kMaxNpyHeader = 1 << 20, kMaxColumns = 32;
constexpr const char* kTransposeAdvice =
    "; transpose an array with its channels first: array.T or numpy.moveaxis(array, 0, -1)";

/// Parses the header, a Python dictionary, as YAML. Converts tuples to lists.
YAML::Node npyHeaderOf(const std::filesystem::path& file, std::string text) {
    char quote = '\0';
    for (char& c : text) {
        if (quote != '\0') {
            if (c == quote) quote = '\0';
        } else if (c == '\'' || c == '"') {
            quote = c;
        } else if (c == '(' || c == ')') {
            c = c == '(' ? '[' : ']';
        }
    }
    try {
        const YAML::Node header = YAML::Load(text);
        if (header.IsMap()) return header;
    } catch (const YAML::Exception&) {
    }
    throw BrokenRecording(file.string() + ": its NPY header is not a valid dictionary");
}

YAML::Node npyValueOf(const std::filesystem::path& file, const YAML::Node& header,
                      const char* key) {
    if (header[key]) return header[key];
    throw BrokenRecording(file.string() + ": its NPY header has no '" + key + "'");
}

/// True for strings, which are quoted. Numbers are not; in old Python versions, they may end in L.
bool isQuoted(const YAML::Node& node) { return node.IsScalar() && node.Tag() == "!"; }

std::optional<std::uint64_t> sizeIn(const YAML::Node& node) {
    if (!node.IsScalar() || isQuoted(node)) return std::nullopt;
    std::string_view digits = node.Scalar();
    if (!digits.empty() && digits.back() == 'L') digits.remove_suffix(1);
    return base::numberFrom<std::uint64_t>(digits);
}

/// A type such as "<f4".
struct ItemType {
    std::optional<NumberType> type;  ///< nullopt if not a plain number
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
    // The size of a skipped type follows its letter: M8[ns] has 8 bytes, U5 has 5 letters.
    const std::size_t end = std::min(name.find('['), name.size());
    const auto size =
        end > 1 ? base::numberFrom<std::uint32_t>(std::string_view(name).substr(1, end - 1))
                : std::nullopt;
    if (!size || name[0] == 'O') {
        throw BrokenRecording(file.string() + ": unknown number type '" + text.substr(0, 40) + "'");
    }
    item.bytes = name[0] == 'U' ? std::size_t{4} * *size : *size;
    item.order = '|';
    return item;
}

/// The product of sizes `first` to `last` in a tuple, or a single size.
std::size_t productOf(const std::filesystem::path& file, const YAML::Node& sizes, std::size_t first,
                      std::size_t last) {
    std::size_t product = 1;
    for (std::size_t i = first; i < last; ++i) {
        const auto size = sizeIn(sizes.IsSequence() ? sizes[i] : sizes);
        if (!size || __builtin_mul_overflow(product, *size, &product)) {
            throw BrokenRecording(file.string() + ": the shape in its NPY header is too large");
        }
    }
    return product;
}

/// Sets the byte order of the array. Throws BrokenRecording if numbers differ in byte order.
void takeOrder(const std::filesystem::path& file, char order, char& all) {
    if (order == '|') return;
    if (all != '|' && all != order) {
        throw BrokenRecording(file.string() + ": mixes little-endian and big-endian numbers");
    }
    all = order;
}

void takeNpyFields(const std::filesystem::path& file, const YAML::Node& descr, CloudFile& cloud,
                   char& order) {
    std::string left_out;
    for (const YAML::Node& field : descr) {
        if (!field.IsSequence() || field.size() < 2) {
            throw BrokenRecording(file.string() + ": its NPY header has an invalid 'descr'");
        }
        // A field with a title has a pair instead of a name.
        const YAML::Node named =
            field[0].IsSequence() && field[0].size() == 2 ? field[0][1] : field[0];
        const std::string name = named.IsScalar() ? named.Scalar() : "";
        std::size_t count = 1;
        if (field.size() > 2) {
            const YAML::Node shape = field[2];
            count = productOf(file, shape, 0, shape.IsSequence() ? shape.size() : 1);
        }
        if (!isQuoted(field[1])) {
            throw BrokenRecording(file.string() + ": its field '" + name +
                                  "' has nested fields, which are not supported");
        }
        const ItemType item = itemTypeOf(file, field[1].Scalar());
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
            throw BrokenRecording(file.string() + ": the size of its field '" + name +
                                  "' is too large");
        }
    }
    if (!left_out.empty()) {
        cloud.remarks.push_back("fields that are not plain numbers are not read: " + left_out);
    }
}

/// Creates the columns of a plain array: x, y, z, intensity, field_4 and so on.
void takeNpyColumns(const std::filesystem::path& file, const std::string& descr,
                    std::size_t columns, CloudFile& cloud, char& order) {
    const ItemType item = itemTypeOf(file, descr);
    if (!item.type) {
        throw BrokenRecording(file.string() + ": its numbers have the unsupported type '" +
                              descr.substr(0, 40) +
                              "'; convert them, for example with .astype(numpy.float32)");
    }
    if (columns < 3 || columns > kMaxColumns) {
        throw BrokenRecording(file.string() + ": the array must have 3 to " +
                              std::to_string(kMaxColumns) + " columns (x, y, z, ...), not " +
                              std::to_string(columns) + kTransposeAdvice);
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

/// True for the shape of x, y, z and perhaps intensity as separate arrays: (3, N), (4, H, W).
/// Throws BrokenRecording if the shape could be either.
bool hasChannelsFirst(const std::filesystem::path& file, std::size_t first, std::size_t last) {
    constexpr std::size_t kMaxPlausibleColumns = 8;
    if ((first != 3 && first != 4) || last <= kMaxPlausibleColumns) return false;
    if (last > kMaxColumns) return true;
    throw BrokenRecording(file.string() + ": its shape has " + std::to_string(first) +
                          " channels or " + std::to_string(last) + " columns" + kTransposeAdvice);
}

/// Converts an array from column-major order to point records.
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
        throw BrokenRecording(file.string() + ": ends within its NPY header");
    const std::size_t length =
        is_long ? numberAt<std::uint32_t>(bytes, kLength) : numberAt<std::uint16_t>(bytes, kLength);
    if (length > bytes.size() - text_start) {
        throw BrokenRecording(file.string() + ": ends within its NPY header");
    }
    if (length > kMaxNpyHeader)
        throw BrokenRecording(file.string() + ": its NPY header is too large");
    const std::string text(reinterpret_cast<const char*>(bytes.data()) + text_start, length);
    const YAML::Node header = npyHeaderOf(file, text);
    const YAML::Node descr = npyValueOf(file, header, "descr");
    const YAML::Node shape = npyValueOf(file, header, "shape");
    const bool is_by_column = npyValueOf(file, header, "fortran_order").Scalar() == "True";

    CloudFile cloud;
    const bool is_plain = isQuoted(descr);
    const std::size_t dimensions = shape.size();
    if (!shape.IsSequence() || (!is_plain && !descr.IsSequence())) {
        throw BrokenRecording(file.string() + ": its NPY header has an invalid 'shape' or 'descr'");
    }
    if (is_plain && dimensions < 2) {
        throw BrokenRecording(file.string() +
                              ": the array must have at least two dimensions, N x 3 or more "
                              "(x, y, z, ...)");
    }
    if (is_by_column && dimensions > (is_plain ? 2 : 1)) {
        throw BrokenRecording(
            file.string() +
            ": is in Fortran order with several dimensions, which is not supported; save "
            "numpy.ascontiguousarray() of it");
    }
    const auto sizeOf = [&](std::size_t i) { return productOf(file, shape, i, i + 1); };
    std::size_t first = 0;  // of the dimensions, without a batch of one
    while (is_plain && first + 2 < dimensions && sizeOf(first) == 1) ++first;
    const bool are_channels_first =
        is_plain && hasChannelsFirst(file, sizeOf(first), sizeOf(dimensions - 1));
    cloud.table.points = productOf(file, shape, first + (are_channels_first ? 1 : 0),
                                   dimensions - (is_plain && !are_channels_first ? 1 : 0));
    char order = '|';
    if (is_plain) {
        takeNpyColumns(file, descr.Scalar(), sizeOf(are_channels_first ? first : dimensions - 1),
                       cloud, order);
    } else {
        takeNpyFields(file, descr, cloud, order);
    }
    const std::size_t start = text_start + length;
    checkRoom(file, cloud.table.points, cloud.table.bytes_per_point, bytes.size() - start);
    const std::size_t size = cloud.table.points * cloud.table.bytes_per_point;
    for (std::string& rest : remarkOnRest(bytes.size() - start - size)) {
        cloud.remarks.push_back(std::move(rest));
    }
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(start));
    bytes.resize(size);
    if (is_plain && is_by_column != are_channels_first) {
        bytes = transposed(bytes, cloud.table.points, cloud.table.fields.size(),
                           bytesOf(cloud.table.fields[0].type));
    }
    if (are_channels_first) {
        cloud.remarks.push_back("channels first: read as " + std::to_string(cloud.table.points) +
                                " points of " + std::to_string(cloud.table.fields.size()) +
                                " numbers");
    }
    cloud.table.is_big_endian = order == '>';
    cloud.table.bytes = std::move(bytes);
    return cloud;
}

}  // namespace hagen::recordings
