// `ncvet explain`, `ncvet rules` and `ncvet dialects`: what there is, and what it means.
#pragma once

#include "analyzer/cli/command.h"
#include "analyzer/rule/rule_table.h"

namespace ncvet::cli {

class ExplainCommand final : public Command {
public:
  ExplainCommand();
  int run() override;

private:
  void write(const RuleEntry &entry) const;

  std::vector<std::string> rule_;
  std::string dialect_;
  bool all_ = false;
};

class RulesCommand final : public Command {
public:
  RulesCommand();
  int run() override;

private:
  std::string format_ = "text";
};

class DialectsCommand final : public Command {
public:
  DialectsCommand();
  int run() override;

private:
  std::string check_;
};

} // namespace ncvet::cli
