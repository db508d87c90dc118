// Headers that nearly every rule includes, beside those that all sources share; only the build
// knows of this file. An edit of what a rule is told makes all rules stale, with or without it.
#pragma once

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
