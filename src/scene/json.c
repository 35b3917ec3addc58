/* SPDX-License-Identifier: BSD-3-Clause */
#include "scene/json.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"
#include "base/buffer.h"
#include "base/message.h"

/* Largest length of a number, in characters. A double needs 24 characters at most to be exact. */
enum { NUMBER = 40 };

typedef struct parser {
  const char *at;
  const char *end;
  int line;
  int depth;
  const char *label;
  baum_i_json *json;
  char *free; /* unused part of json->texts */
} parser;

static baum_status fail(const parser *p, const char *what)
{
  (void)baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: %s", p->label, p->line, what);
  return BAUM_ERR_ARGUMENT; /* tells a static analyzer that this is a failure */
}

/* Return the next character, or 0 at the end of the text. A zero inside the text needs no special
 * treatment, because JSON does not allow this character. */
static char peek(const parser *p)
{
  return p->at < p->end ? *p->at : '\0';
}

static void skip_blanks(parser *p)
{
  while (p->at < p->end && memchr(" \t\r\n", *p->at, 4)) {
    p->line += *p->at == '\n' ? 1 : 0;
    p->at++;
  }
}

static bool take(parser *p, char c)
{
  bool found = peek(p) == c && p->at < p->end;
  p->at += found ? 1 : 0;
  return found;
}

static bool take_word(parser *p, const char *word)
{
  size_t size = strlen(word);
  bool found = (size_t)(p->end - p->at) >= size && memcmp(p->at, word, size) == 0;
  p->at += found ? size : 0;
  return found;
}

/* ---- numbers ---- */

static bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}

/* Skip digits. Returns false if there are none. */
static bool skip_digits(parser *p)
{
  const char *first = p->at;
  while (is_digit(peek(p))) {
    p->at++;
  }
  return p->at > first;
}

static bool skip_number(parser *p)
{
  (void)take(p, '-');
  bool good = take(p, '0') || skip_digits(p);
  if (good && take(p, '.')) {
    good = skip_digits(p);
  }
  if (good && (take(p, 'e') || take(p, 'E'))) {
    (void)(take(p, '+') || take(p, '-'));
    good = skip_digits(p);
  }
  return good;
}

static baum_status parse_number(parser *p, double *out)
{
  const char *first = p->at;
  char copy[NUMBER + 1];
  if (!skip_number(p)) {
    return fail(p, "this is not JSON: a value is expected here");
  }
  size_t size = (size_t)(p->at - first);
  if (size > NUMBER) {
    return fail(p, "a number has more than 40 characters");
  }
  memcpy(copy, first, size);
  copy[size] = '\0';
  if (!baum_i_read_number(copy, out) || !isfinite(*out)) {
    return fail(p, "a number is too large");
  }
  return BAUM_OK;
}

/* ---- texts ---- */

static int hex_value(char c)
{
  static const char digits[] = "0123456789abcdef0123456789ABCDEF";
  const char *found = c ? strchr(digits, c) : NULL;
  return found ? (int)(found - digits) % 16 : -1;
}

/* Read the four digits after \u. Returns -1 if there are fewer. */
static int32_t take_unit(parser *p)
{
  int32_t unit = 0;
  for (int k = 0; k < 4; k++) {
    int digit = hex_value(peek(p));
    if (digit < 0) {
      return -1;
    }
    unit = 16 * unit + digit;
    p->at++;
  }
  return unit;
}

/* Read the character whose code follows \u. The code may consist of two UTF-16 units. Returns -1 if
 * the code is not valid. */
static int32_t take_code(parser *p)
{
  int32_t code = take_unit(p);
  if (code < 0xd800 || code > 0xdfff) {
    return code;
  }
  int32_t low = code < 0xdc00 && take_word(p, "\\u") ? take_unit(p) : -1;
  return low >= 0xdc00 && low <= 0xdfff ? 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00) : -1;
}

static void put_code(parser *p, int32_t code)
{
  static const int32_t first[] = {0, 0, 0xc0, 0xe0, 0xf0};
  const int count = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
  for (int k = count - 1; k > 0; k--) {
    p->free[k] = (char)(0x80 | (code & 0x3f));
    code >>= 6;
  }
  p->free[0] = (char)(count == 1 ? code : first[count] | code);
  p->free += count;
}

static baum_status take_escape(parser *p)
{
  static const char names[] = "\"\\/bfnrt";
  static const char values[] = "\"\\/\b\f\n\r\t";
  const char *found = peek(p) ? strchr(names, peek(p)) : NULL;
  if (found) {
    p->at++;
    *p->free++ = values[found - names];
    return BAUM_OK;
  }
  int32_t code = take(p, 'u') ? take_code(p) : -1;
  if (code <= 0) {
    return fail(p, "this is not JSON: a text has a backslash without a valid character after it");
  }
  put_code(p, code);
  return BAUM_OK;
}

static baum_status parse_text(parser *p, const char **out)
{
  if (!take(p, '"')) {
    return fail(p, "this is not JSON: a text in double quotes is expected here");
  }
  *out = p->free;
  while (!take(p, '"')) {
    if ((unsigned char)peek(p) < 0x20) {
      return fail(p, "this is not JSON: a text does not end, or has a control character");
    }
    if (take(p, '\\')) {
      BAUM_I_TRY(take_escape(p));
    } else {
      *p->free++ = *p->at++;
    }
  }
  *p->free++ = '\0';
  return BAUM_OK;
}

/* ---- values ---- */

static baum_status add_node(parser *p, int32_t *index)
{
  baum_i_json *json = p->json;
  void *nodes = baum_i_grow_by_one(json->nodes, (size_t)json->count + 1, sizeof *json->nodes);
  BAUM_I_TRY(baum_i_check_memory(nodes));
  json->nodes = nodes;
  json->nodes[json->count] = (baum_i_json_node){.line = p->line};
  *index = json->count++;
  return BAUM_OK;
}

static baum_status parse_value(parser *p, const char *key, int32_t *index);

static baum_status parse_key(parser *p, int32_t owner, const char **key)
{
  if (p->json->nodes[owner].count >= BAUM_I_JSON_KEYS) {
    return fail(p, "an object has too many keys");
  }
  BAUM_I_TRY(parse_text(p, key));
  if (baum_i_json_find(p->json, &p->json->nodes[owner], *key)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: the key \"%.80s\" appears twice", p->label,
                       p->line, *key);
  }
  skip_blanks(p);
  return take(p, ':') ? BAUM_OK : fail(p, "this is not JSON: a colon is expected after a key");
}

/* Parse the values of a list or object up to the closing bracket. */
static baum_status parse_values(parser *p, int32_t owner, bool keys, char close)
{
  int32_t last = 0;
  do {
    const char *key = NULL;
    int32_t index = 0;
    skip_blanks(p);
    if (keys) {
      BAUM_I_TRY(parse_key(p, owner, &key));
    }
    BAUM_I_TRY(parse_value(p, key, &index));
    baum_i_json_node *nodes = p->json->nodes;
    *(last ? &nodes[last].next : &nodes[owner].first) = index;
    nodes[owner].count++;
    last = index;
    skip_blanks(p);
  } while (take(p, ','));
  return take(p, close) ? BAUM_OK : fail(p, "this is not JSON: a comma or a bracket is missing");
}

static baum_status parse_group(parser *p, int32_t owner, bool keys, char close)
{
  if (++p->depth > BAUM_I_JSON_DEPTH) {
    return fail(p, "brackets are nested too deeply");
  }
  skip_blanks(p);
  if (!take(p, close)) {
    BAUM_I_TRY(parse_values(p, owner, keys, close));
  }
  p->depth--;
  return BAUM_OK;
}

static baum_status parse_value(parser *p, const char *key, int32_t *index)
{
  skip_blanks(p);
  BAUM_I_TRY(add_node(p, index));
  baum_i_json_node *node = &p->json->nodes[*index];
  node->key = key;
  if (take(p, '{')) {
    node->kind = BAUM_I_JSON_OBJECT;
    return parse_group(p, *index, true, '}');
  }
  if (take(p, '[')) {
    node->kind = BAUM_I_JSON_LIST;
    return parse_group(p, *index, false, ']');
  }
  if (peek(p) == '"') {
    node->kind = BAUM_I_JSON_TEXT;
    return parse_text(p, &node->text);
  }
  static const struct {
    const char *word;
    baum_i_json_kind kind;
  } words[] = {
    {"null", BAUM_I_JSON_NULL}, {"false", BAUM_I_JSON_FALSE}, {"true", BAUM_I_JSON_TRUE}};
  for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
    if (take_word(p, words[k].word)) {
      node->kind = words[k].kind;
      return BAUM_OK;
    }
  }
  node->kind = BAUM_I_JSON_NUMBER;
  return parse_number(p, &node->number);
}

baum_status baum_i_json_parse(const char *text, size_t size, const char *label, baum_i_json *out)
{
  *out = (baum_i_json){.texts = baum_i_alloc(size, 1)};
  BAUM_I_TRY(baum_i_check_memory(out->texts));
  bool has_mark = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0; /* byte order mark of UTF-8 */
  parser p = {has_mark ? text + 3 : text, text + size, 1, 0, label, out, out->texts};
  int32_t whole = 0;
  baum_status status =
    size < INT32_MAX ? parse_value(&p, NULL, &whole) : fail(&p, "the text is too long");
  skip_blanks(&p);
  if (status == BAUM_OK && p.at < p.end) {
    status = fail(&p, "this is not JSON: there is more text after the end of the first value");
  }
  if (status != BAUM_OK) {
    baum_i_json_release(out);
  }
  return status;
}

void baum_i_json_release(baum_i_json *json)
{
  baum_i_free(json->nodes);
  baum_i_free(json->texts);
  *json = (baum_i_json){0};
}

/* ---- the tree ---- */

const baum_i_json_node *baum_i_json_first(const baum_i_json *json, const baum_i_json_node *node)
{
  return node && node->first ? &json->nodes[node->first] : NULL;
}

const baum_i_json_node *baum_i_json_next(const baum_i_json *json, const baum_i_json_node *node)
{
  return node->next ? &json->nodes[node->next] : NULL;
}

const baum_i_json_node *baum_i_json_find(const baum_i_json *json, const baum_i_json_node *object,
                                         const char *key)
{
  const baum_i_json_node *node = baum_i_json_first(json, object);
  while (node && !(node->key && strcmp(node->key, key) == 0)) {
    node = baum_i_json_next(json, node);
  }
  return node;
}

const char *baum_i_json_name(const baum_i_json_node *node)
{
  static const char *const names[] = {"null",   "false",  "true",     "a number",
                                      "a text", "a list", "an object"};
  return names[node->kind];
}
