/* json.h - prints one JSON object to standard output, a member a line. */
#ifndef CLI_JSON_H
#define CLI_JSON_H

typedef struct json {
    int depth;   /* of the object being written */
    int members; /* written into it so far */
} json;

/* `name` is ignored for the outermost object. */
void json_open(json *out, const char *name);
void json_close(json *out);
void json_text(json *out, const char *name, const char *text); /* bytes that are not UTF-8 become U+FFFD */
void json_integer(json *out, const char *name, long long value);
void json_number(json *out, const char *name, double value); /* null if not finite */
void json_numbers(json *out, const char *name, const double *values, int count);

#endif
