#include <sqlite3.h>

#include <algorithm>
#include <string_view>

#include "recordings/bags/BagFormats.h"
#include "recordings/bags/TopicList.h"
#include "recordings/bags/Unpack.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

/// Returns a URI such as "file:///a%20b.db3". An empty authority is required, because the first
/// folder of a path that starts with "//" would otherwise be the authority.
std::string uriOf(const fs::path& file) {
    std::string uri = "file://";
    for (const char c : fs::absolute(file).string()) {
        const bool is_plain = std::string_view("%?# ").find(c) == std::string_view::npos;
        constexpr std::string_view kHex = "0123456789ABCDEF";
        const auto code = static_cast<unsigned char>(c);
        uri += is_plain ? std::string(1, c) : std::string{'%', kHex[code >> 4], kHex[code & 15]};
    }
    return uri;
}

std::string textAt(sqlite3_stmt* row, int column) {
    const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
    return text == nullptr ? "" : text;
}

class SqliteBag : public BagFile {
 public:
    explicit SqliteBag(const fs::path& file) : file_(file) {
        open();
        readTopics();
        // Two subqueries, because a single query for both would read all messages.
        const Query range =
            prepare("SELECT (SELECT min(id) FROM messages), (SELECT max(id) FROM messages)");
        if (sqlite3_step(range.get()) == SQLITE_ROW) {  // fails if the end of the file is missing
            first_row_ = sqlite3_column_int64(range.get(), 0);
            last_row_ = sqlite3_column_int64(range.get(), 1);
        }
        // IDs are in recording order; sorting by ID requires neither an index nor memory.
        messages_ = prepare("SELECT id, topic_id, timestamp, data FROM messages ORDER BY id");
    }

    bool next(BagMessage& message) override {
        if (!messages_) return false;
        check();
        if (!step(messages_)) {
            messages_.reset();
            return false;
        }
        sqlite3_stmt* const row = messages_.get();
        row_ = sqlite3_column_int64(row, 0);
        const std::int64_t topic_id = sqlite3_column_int64(row, 1);
        const auto topic = topic_of_.find(topic_id);
        if (topic == topic_of_.end()) {
            fail("this message belongs to topic " + std::to_string(topic_id) +
                 ", which does not exist");
        }
        message.topic = topic->second;
        message.time_ns = sqlite3_column_int64(row, 2);
        message.bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(row, 3));
        const int size = sqlite3_column_bytes(row, 3);
        message.size = message.bytes == nullptr ? 0 : static_cast<std::size_t>(size);
        if (sqlite3_errcode(database_.get()) == SQLITE_NOMEM)
            fail("out of memory for this message");
        ++rows_;
        return true;
    }

    const std::vector<BagTopic>& topics() const override { return topics_.all(); }

    double fractionRead() const override {
        const auto all = static_cast<double>(last_row_) - static_cast<double>(first_row_) + 1;
        if (!messages_) return 1.0;
        return rows_ == 0
                   ? 0.0
                   : std::clamp(
                         (static_cast<double>(row_) - static_cast<double>(first_row_) + 1) / all,
                         0.0, 1.0);
    }

 private:
    struct Close {
        void operator()(sqlite3* database) const { sqlite3_close(database); }
        void operator()(sqlite3_stmt* query) const { sqlite3_finalize(query); }
    };
    using Query = std::unique_ptr<sqlite3_stmt, Close>;

    void open() {
        // If there are no pending changes, reading requires no write access.
        std::error_code none;
        bool has_changes = false;
        for (const char* const suffix : {"-wal", "-journal"}) {
            const fs::path log = file_.string() + suffix;
            has_changes = has_changes || (fs::exists(log, none) && fs::file_size(log, none) > 0);
        }
        const std::string uri = uriOf(file_) + (has_changes ? "?mode=ro" : "?mode=ro&immutable=1");
        sqlite3* raw = nullptr;
        const int state =
            sqlite3_open_v2(uri.c_str(), &raw, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
        database_.reset(raw);
        if (state != SQLITE_OK) fail(raw == nullptr ? "out of memory" : sqlite3_errmsg(raw));
        // The schema is untrusted and must not execute code.
        sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
        sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
        sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
        // A small schema can define a blob of any size.
        sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, static_cast<int>(kMaxUnpackedBytes));
        // By default, SQLite rejects truncated files.
        sqlite3_db_config(raw, SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
    }

    Query prepare(const std::string& sql) const {
        sqlite3_stmt* raw = nullptr;
        const int state = sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &raw, nullptr);
        Query query(raw);
        if ((state & 0xff) == SQLITE_CANTOPEN || (state & 0xff) == SQLITE_READONLY) {
            fail(std::string(sqlite3_errmsg(database_.get())) +
                 "; it is being written, or its writer was interrupted: copy it with its -wal and "
                 "-journal files into a writable folder and run there: sqlite3 " +
                 file_.filename().string() + " 'SELECT count(*) FROM messages'");
        }
        if (state != SQLITE_OK) fail(sqlite3_errmsg(database_.get()));
        return query;
    }

    bool step(const Query& query) const {
        const int state = sqlite3_step(query.get());
        if (state == SQLITE_ROW) return true;
        if (state == SQLITE_TOOBIG) {
            fail("a message has more than " + std::to_string(kMaxUnpackedBytes >> 20) + " MB");
        }
        if (state != SQLITE_DONE) fail(sqlite3_errmsg(database_.get()));
        return false;
    }

    void readTopics() {
        const Query topics = prepare("SELECT id, name, type, serialization_format FROM topics");
        while (step(topics)) {
            BagTopic topic{textAt(topics.get(), 1), typeAsInRos1(textAt(topics.get(), 2)),
                           textAt(topics.get(), 3)};
            if (topic.encoding.empty()) topic.encoding = "cdr";
            topic_of_[sqlite3_column_int64(topics.get(), 0)] = topics_.indexOf(topic);
        }
    }

    [[noreturn]] void fail(const std::string& why) const {
        const std::string where = messages_ ? "after " + std::to_string(rows_) + " messages (id " +
                                                  std::to_string(row_) + ")"
                                            : "at its start";
        throw BrokenRecording(file_.string() + ": the database cannot be read " + where + ": " +
                              why);
    }

    std::filesystem::path file_;
    std::unique_ptr<sqlite3, Close> database_;
    Query messages_;
    TopicList topics_;
    std::map<std::int64_t, std::size_t> topic_of_;  ///< topic index by the topic's ID
    std::size_t rows_ = 0;
    std::int64_t row_ = 0, first_row_ = 0, last_row_ = 0;
};

}  // namespace

bool isSqliteBag(const std::string& start) {
    return start.compare(0, kSqliteMagic.size(), kSqliteMagic) == 0;
}

std::unique_ptr<BagFile> openSqliteBag(const std::filesystem::path& file) {
    return std::make_unique<SqliteBag>(file);
}

}  // namespace hagen::recordings
