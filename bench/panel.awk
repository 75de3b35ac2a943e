# panel.awk - a panel of table1.svg: error against seconds, both logarithmic, a line for each method; by bounces.sh.
#
# Input: rows "method n seconds error".  left: where it begins, in pixels; title: what stands above it.

function place_x(s) { return left + 60 + 300 * (log(s) - low_x) / (high_x - low_x) }
function place_y(e) { return 260 - 200 * (log(e) - low_y) / (high_y - low_y) }
{
    s = $3 > 0.001 ? $3 : 0.001; e = $4 > 1e-4 ? $4 : 1e-4
    seconds[NR] = s; error[NR] = e; method[NR] = $1
    if (NR == 1) { low_x = high_x = log(s); low_y = high_y = log(e) }
    if (log(s) < low_x) low_x = log(s); if (log(s) > high_x) high_x = log(s)
    if (log(e) < low_y) low_y = log(e); if (log(e) > high_y) high_y = log(e)
    if (!($1 in colour)) { names[++count] = $1; colour[$1] = substr("#06c#c30#393", 4 * count - 3, 4) }
}
END {
    if (high_x - low_x < 0.1) high_x = low_x + 0.1
    low_y -= 0.2; high_y += 0.2
    printf "<text x=\"%d\" y=\"20\">%s</text>\n", left + 60, title
    for (power = -4; power <= 0; power++) for (part = 1; part <= 3; part += 2) {
        e = part * 10 ^ power
        if (log(e) < low_y || log(e) > high_y) continue
        printf "<path d=\"M%d %.1f h300\" stroke=\"#ccc\"/>", left + 60, place_y(e)
        printf "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">", left + 54, place_y(e) + 4
        printf "%g %%</text>\n", 100 * e
    }
    for (power = -3; power <= 4; power++) {
        if (power * log(10) < low_x || power * log(10) > high_x) continue
        x = place_x(10 ^ power)
        printf "<path d=\"M%.1f 60 v200\" stroke=\"#ccc\"/>", x
        printf "<text x=\"%.1f\" y=\"276\" text-anchor=\"middle\">%g s</text>\n", x, 10 ^ power
    }
    for (k = 1; k <= count; k++) {
        name = names[k]
        printf "<text x=\"%d\" y=\"36\" fill=\"%s\">%s</text>\n", left + 100 * k - 40, colour[name], name
        printf "<polyline fill=\"none\" stroke=\"%s\" points=\"", colour[name]
        for (i = 1; i <= NR; i++)
            if (method[i] == name) printf "%.1f,%.1f ", place_x(seconds[i]), place_y(error[i])
        print "\"/>"
    }
    for (i = 1; i <= NR; i++)
        printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n",
            place_x(seconds[i]), place_y(error[i]), colour[method[i]]
}
