#include "Plan.h"

#include <yaml-cpp/yaml.h>
#include "base/NumberText.h"
#include "evaluation/Degradation.h"
#include "filter/OptionKeys.h"

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>

namespace hagen::selection {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const YAML::Node& node, const std::string& what) {
    throw std::runtime_error(file.string() + ":" + std::to_string(node.Mark().line + 1) + ": " +
                             what);
}

using Entry = std::function<void(const std::string& key, const YAML::Node& value)>;

void forEachEntry(const fs::path& file, const YAML::Node& map, const Entry& entry) {
    if (!map.IsMap()) fail(file, map, "expected a map of keys and values");
    std::set<std::string> keys;
    for (const auto& item : map) {
        if (!item.first.IsScalar()) fail(file, item.first, "expected a key");
        const std::string key = item.first.Scalar();
        if (!keys.insert(key).second) fail(file, item.first, key + " occurs twice");
        entry(key, item.second);
    }
}

std::vector<std::string> textsOf(const fs::path& file, const std::string& key,
                                 const YAML::Node& list) {
    if (!list.IsSequence() || list.size() == 0) fail(file, list, key + ": expected a list");
    std::vector<std::string> texts;
    for (const YAML::Node& item : list) {
        if (!item.IsScalar()) fail(file, item, key + ": expected a list of values");
        texts.push_back(item.Scalar());
    }
    return texts;
}

bool contains(const std::vector<std::string>& texts, const std::string& text) {
    return std::find(texts.begin(), texts.end(), text) != texts.end();
}

const OptionKey& optionKey(const std::string& name) {
    const std::vector<OptionKey>& keys = optionKeys();
    return *std::find_if(keys.begin(), keys.end(),
                         [&](const OptionKey& key) { return key.name == name; });
}

/// The value in normalised form, so that 0.10 equals 0.1.
std::string checkedValue(const std::string& key, const std::string& value) {
    Settings settings;
    setOption(key, value, settings);  // throws on invalid values
    return textOf(optionKey(key), settings.options);
}

Setting settingOf(const fs::path& file, const std::string& key, const YAML::Node& list) {
    Setting setting{key, {}};
    for (const std::string& value : textsOf(file, key, list)) {
        try {
            setting.values.push_back(checkedValue(key, value));
        } catch (const SettingsError& e) {
            fail(file, list, e.what());
        }
    }
    const std::set<std::string> different(setting.values.begin(), setting.values.end());
    if (different.size() < setting.values.size()) fail(file, list, key + ": a value occurs twice");
    return setting;
}

std::vector<std::string> hardSetsOf(const fs::path& file, const YAML::Node& list) {
    std::vector<std::string> texts = textsOf(file, "hard_sets", list);
    for (const std::string& text : texts) {
        try {
            evaluation::Degradation{text};
        } catch (const std::invalid_argument& e) {
            fail(file, list, "hard_sets: " + std::string(e.what()));
        }
    }
    return texts;
}

std::string plainValue(const fs::path& file, const Plan& plan, const std::string& key,
                       const YAML::Node& node) {
    for (const Setting& setting : plan.settings) {
        if (setting.key != key || !node.IsScalar()) continue;
        try {
            const std::string value = checkedValue(key, node.Scalar());
            if (contains(setting.values, value)) return value;
        } catch (const SettingsError& e) {
            fail(file, node, e.what());
        }
    }
    fail(file, node, "plain: " + key + " must have one of its values under settings");
}

}  // namespace

Plan readPlan(const fs::path& file) {
    YAML::Node root;
    try {
        root = YAML::LoadFile(file.string());
    } catch (const YAML::BadFile&) {
        throw std::runtime_error(file.string() + ": cannot be read");
    } catch (const YAML::Exception& e) {
        throw std::runtime_error(file.string() + ": is not YAML: " + e.what());
    }
    Plan plan;
    YAML::Node plain(YAML::NodeType::Map);
    forEachEntry(file, root, [&](const std::string& key, const YAML::Node& value) {
        if (key == "rounds") {
            const auto rounds =
                value.IsScalar() ? base::numberFrom<int>(value.Scalar()) : std::optional<int>();
            if (!rounds || *rounds < 1) fail(file, value, "rounds: a number of at least 1");
            plan.max_rounds = *rounds;
        } else if (key == "hard_sets") {
            plan.hard_sets = hardSetsOf(file, value);
        } else if (key == "settings") {
            forEachEntry(file, value, [&](const std::string& name, const YAML::Node& list) {
                plan.settings.push_back(settingOf(file, name, list));
            });
        } else if (key == "plain") {
            plain = value;
        } else {
            fail(file, value, "unknown key " + key + "; known: rounds, hard_sets, settings, plain");
        }
    });
    if (plan.settings.empty()) throw std::runtime_error(file.string() + ": has no settings");
    forEachEntry(file, plain, [&](const std::string& key, const YAML::Node& value) {
        plan.plain[key] = plainValue(file, plan, key, value);
    });
    return plan;
}

Choice presentChoice(const std::vector<fs::path>& presets, Plan& plan) {
    Choice choice;
    for (Setting& setting : plan.settings) {
        std::string present;
        for (const fs::path& preset : presets) {
            Settings settings;
            mergeSettings(preset, settings);
            const std::string value = textOf(optionKey(setting.key), settings.options);
            if (!present.empty() && value != present) {
                throw std::runtime_error(setting.key + " is " + present + " in " +
                                         presets.front().string() + ", but " + value + " in " +
                                         preset.string() + "; it cannot be chosen for all sensors");
            }
            present = value;
        }
        auto place = std::find(setting.values.begin(), setting.values.end(), present);
        if (place == setting.values.end())
            place = setting.values.insert(setting.values.begin(), present);
        choice.push_back(static_cast<std::size_t>(place - setting.values.begin()));
    }
    return choice;
}

Choice plainChoice(const Plan& plan, Choice present) {
    for (std::size_t s = 0; s < plan.settings.size(); ++s) {
        const auto plain = plan.plain.find(plan.settings[s].key);
        if (plain == plan.plain.end()) continue;
        const std::vector<std::string>& values = plan.settings[s].values;
        const auto place = std::find(values.begin(), values.end(), plain->second);
        present[s] = static_cast<std::size_t>(place - values.begin());
    }
    return present;
}

void apply(const std::vector<Setting>& settings, const Choice& choice, Settings& target) {
    for (std::size_t s = 0; s < settings.size(); ++s)
        setOption(settings[s].key, settings[s].values[choice[s]], target);
}

}  // namespace hagen::selection
