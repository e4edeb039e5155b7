# awk -f compare.awk -v cores="rv32 rv64" record.md measured.md: what differs between two outputs of run.sh for these
# cores. Fails where a figure has grown by more than 2 %, where one of them has a row that the other has not, or where
# the instructions that lqgen states of a step are off by more than a fifth, and by more than 12.
BEGIN {
    FS = " *[|] *"
    split(cores, list, " ")
    for (i in list)
        is_asked[list[i]] = 1
}

/^## / { core = substr($0, 4) }

/^[|] design / { for (i = 5; i < NF; i++) title[i] = ($i == "most" ? "most " $(i - 1) : $i) }

# A row: "| title | style | real | figures … |".
/^[|] [a-z]/ && !/^[|] design / && is_asked[core] {
    row = core ", " $2 ", " $3 ", " $4
    if (FILENAME == ARGV[1]) {
        recorded[row] = 1
        for (i = 5; i < NF; i++)
            figure[row, i] = $i + 0
    } else if (!(row in recorded)) {
        say(row ": not in the record")
        failed = 1
    } else {
        delete recorded[row]
        rows++
        for (i = 5; i < NF; i++) {
            compare(row ": " title[i], figure[row, i], $i + 0)
            if (title[i] == "step")
                judge(row, $i)
        }
    }
}

END {
    for (row in recorded) {
        say(row ": in the record, but not measured")
        failed = 1
    }
    print rows + 0 " rows compared, " differences + 0 " differences"
    if (differences && !failed)
        print "To take them over: test/bench/run.sh --update"
    exit failed || !rows
}

function say(what) {
    print what
    differences++
}

# "123 (120)": counted, stated.
function judge(row, text,    stated) {
    if (text !~ /[(]/)
        return
    stated = substr(text, index(text, "(") + 1) + 0
    if ((stated > 1.2 * text || stated < 0.8 * text) && (stated - text > 12 || text - stated > 12)) {
        say(row ": a step of " text + 0 " instructions, lqgen states " stated)
        failed = 1
    }
}

# What lqgen estimates stands behind a figure in brackets and does not count.
function compare(what, before, now) {
    if (now == before)
        return
    say(what " " before " → " now)
    if (now > 1.02 * before)
        failed = 1
}
