# flicker.awk - does a film flicker?  Reads what the film shows and what it ought to show, a line a point, `points` lines
# a frame, frame after frame:
#
#   R G B R' G' B'        film, then the environment filtered exactly
#
# and prints a line of three numbers in levels of 256, 255 being a radiance of 1: how much the film's error changes its
# pace, the root mean square of its second difference in time, e(t-1) - 2 e(t) + e(t+1); how much the truth does; and the
# root mean square error itself.  An error that stays, or goes on as the picture does, is not seen as flicker; one that
# comes and goes from frame to frame is, even a small one, and its second difference is 2.4 times as large as itself.

NF == 6 {
    frame = int(lines / points)
    p = lines % points
    lines++
    for (c = 1; c <= 3; c++) {
        truth[frame, p, c] = $(c + 3)
        error[frame, p, c] = $c - $(c + 3)
        squares += error[frame, p, c] ^ 2
        count++
    }
}

END {
    frames = int(lines / points)
    if (points < 1 || frames < 3 || lines % points != 0) {
        print "flicker.awk: three whole frames at least are needed" >"/dev/stderr"
        exit 1
    }
    for (f = 1; f < frames - 1; f++)
        for (p = 0; p < points; p++)
            for (c = 1; c <= 3; c++) {
                of_error += (error[f - 1, p, c] - 2 * error[f, p, c] + error[f + 1, p, c]) ^ 2
                of_truth += (truth[f - 1, p, c] - 2 * truth[f, p, c] + truth[f + 1, p, c]) ^ 2
                terms++
            }
    printf "%.3f %.3f %.3f\n", 255 * sqrt(of_error / terms), 255 * sqrt(of_truth / terms), 255 * sqrt(squares / count)
}
