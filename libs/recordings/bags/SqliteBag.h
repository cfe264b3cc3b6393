#pragma once
#include <hagen/recordings/BagFile.h>

#include <exception>
#include <map>
#include <memory>

#include "recordings/bags/TopicList.h"

struct sqlite3;
struct sqlite3_stmt;

namespace hagen::recordings {

/// A database of a ROS 2 bag (.db3), read row by row. Messages that are packed one by one (zstd)
/// are unpacked by who decodes them.
class SqliteBag : public BagFile {
 public:
    static bool isOne(const std::string& start);
    explicit SqliteBag(const std::filesystem::path& file);
    ~SqliteBag() override;

    bool next(BagMessage& message) override;
    const std::vector<BagTopic>& topics() const override { return topics_.all(); }
    double fractionRead() const override;

 private:
    struct Close {
        void operator()(sqlite3* database) const;
        void operator()(sqlite3_stmt* query) const;
    };
    using Query = std::unique_ptr<sqlite3_stmt, Close>;

    static int checkDuringQuery(void* bag);
    void open();
    Query prepare(const std::string& sql) const;
    bool step(const Query& query) const;
    void checkTables() const;
    void checkColumns() const;
    void readTopics();
    [[noreturn]] void fail(const std::string& why) const;

    std::filesystem::path file_;
    std::unique_ptr<sqlite3, Close> database_;
    Query messages_;
    mutable std::exception_ptr interruption_;  ///< thrown by the check during a query
    TopicList topics_;
    std::map<std::int64_t, std::size_t> topic_of_;  ///< by the topic's id
    std::size_t rows_ = 0;
    std::int64_t row_ = 0, first_row_ = 0, last_row_ = 0;
    std::string cut_because_;  ///< empty: the file is as long as it says
};

}  // namespace hagen::recordings
