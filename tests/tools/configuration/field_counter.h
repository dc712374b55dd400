#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "tools/configuration/field_range.h"

namespace sparsight::testing {

// Every member of a struct is visited: Any converts to whatever a member is, so an aggregate can be
// initialised with as many of them as it has members, and not with one more.
struct Any {
  template <typename Member>
  operator Member() const;  // NOLINT(google-explicit-constructor)
};

template <typename Struct, typename... Members>
constexpr int member_count() {
  if constexpr (requires { Struct{Members{}..., Any{}}; }) {
    return member_count<Struct, Members..., Any>();
  } else {
    return sizeof...(Members);
  }
}

// Visits a struct of settings and those in it; each must be visited member by member.
struct FieldCounter {
  template <typename Value>
  void field(std::string_view, Value&, FieldRange) {
    ++count;
  }
  template <typename Value>
  void required_field(std::string_view, Value&, FieldRange) {
    ++count;
  }
  void field(std::string_view, bool&) { ++count; }
  void text(std::string_view, std::string&, const TextRule&) { ++count; }
  template <typename Enum, typename Names>
  void choice(std::string_view, Enum&, const Names&) {
    ++count;
  }
  template <typename Struct>
  void table(std::string_view key, Struct& value) {
    ++count;
    FieldCounter inner;
    visit_fields(inner, value);
    EXPECT_EQ(inner.count, member_count<Struct>())
        << "[" << key << "]: visit_fields() and the struct have different fields";
  }
  template <typename Struct>
  void optional_table(std::string_view key, Struct& value, bool) {
    table(key, value);
  }
  template <typename List>
  void list(std::string_view key, List&) {
    typename List::value_type element;
    table(key, element);
  }
  template <typename Transform>
  void transform(std::string_view, Transform&, std::string_view) {
    ++count;
  }
  void require(std::string_view) {}
  void check(std::string_view, bool, const std::string&) {}

  int count = 0;
};

}  // namespace sparsight::testing
