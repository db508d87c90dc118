// Parses files with a grammar of tree-sitter, and prints the words that it finds: `KIND BEGIN END`, a line each, after a line
// with the file's name; ERROR and MISSING are kinds as well. First the query of colours is compiled: words QUERY FILE...
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tree_sitter/api.h>

const TSLanguage *LANGUAGE(void);

static char *readFile(const char *name, uint32_t *length) {
  FILE *file = fopen(name, "rb");
  if (!file) {
    perror(name);
    exit(2);
  }
  fseek(file, 0, SEEK_END);
  *length = (uint32_t)ftell(file);
  rewind(file);
  char *text = malloc(*length + 1);
  *length = (uint32_t)fread(text, 1, *length, file);
  fclose(file);
  return text;
}

static void printWords(TSNode node) {
  const uint32_t count = ts_node_child_count(node);
  if (ts_node_is_missing(node) || !strcmp(ts_node_type(node), "ERROR") || (count == 0 && ts_node_is_named(node)))
    printf("%s %u %u\n", ts_node_is_missing(node) ? "MISSING" : ts_node_type(node), ts_node_start_byte(node),
           ts_node_end_byte(node));
  for (uint32_t i = 0; i < count; ++i)
    printWords(ts_node_child(node, i));
}

int main(int argc, char **argv) {
  uint32_t length, where;
  TSQueryError error;
  char *query = readFile(argv[1], &length);
  if (!ts_query_new(LANGUAGE(), query, length, &where, &error)) {
    printf("the query is refused at byte %u: error %d\n", where, error);
    return 1;
  }
  TSParser *parser = ts_parser_new();
  if (!ts_parser_set_language(parser, LANGUAGE()))
    return 1;
  for (int i = 2; i < argc; ++i) {
    char *text = readFile(argv[i], &length);
    TSTree *tree = ts_parser_parse_string(parser, NULL, text, length);
    printf("%s\n", argv[i]);
    printWords(ts_tree_root_node(tree));
    ts_tree_delete(tree);
    free(text);
  }
  ts_parser_delete(parser);
  return 0;
}
