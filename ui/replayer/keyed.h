// A value with what it was made of. Whoever shows it asks whether that is what the label beside it says, and draws it dimmed
// where it is not (Widgets::updating).
#pragma once

#include <optional>
#include <utility>

namespace strata::ui {

template <typename Key, typename Value>
class Keyed {
public:
    void set(Key key, Value value) { made_.emplace(std::move(key), std::move(value)); }
    void reset() { made_.reset(); }
    /// The same value is right for this, too.
    void rename(Key key) {
        if (made_) made_->first = std::move(key);
    }

    /// Null until there is one.
    const Value* value() const { return made_ ? &made_->second : nullptr; }
    const Key* key() const { return made_ ? &made_->first : nullptr; }
    bool is_of(const Key& key) const { return made_ && made_->first == key; }

private:
    std::optional<std::pair<Key, Value>> made_;
};

}  // namespace strata::ui
