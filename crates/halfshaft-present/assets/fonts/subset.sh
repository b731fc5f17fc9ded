#!/bin/sh
# Makes the two subsets from the full DejaVu Sans 2.37 fonts in the folder given as argument,
# with pyftsubset of fonttools 4.68.0. Characters left out here appear as a box in PNG output.
set -eu
full=${1:?folder of DejaVuSans.ttf and DejaVuSans-Bold.ttf}
here=$(dirname "$0")

letters="U+0020-007E,U+00A0-017F,U+0218-021B,U+0370-03FF"
signs="U+2010-2015,U+2018-201E,U+2020-2022,U+2026,U+2032-2033,U+2044,U+20AC"
math="U+2070-209F,U+2190-2199,U+2202,U+2206,U+220F,U+2211-2213,U+2219-221A,U+221E,U+222B,U+2248,U+2260,U+2264-2265"
more="U+0192,U+01CD-01DC,U+02B0-02B8,U+02C6-02C7,U+02D8-02DD,U+0300-0308,U+030A-030C,U+0400-045F"
more="$more,U+0490-0491,U+1D2C-1D6A,U+1E9E,U+2000-206F,U+2100-214F,U+2150-215F,U+2190-21FF"
more="$more,U+2200-22FF,U+2300,U+2308-230B,U+25A0-25FF,U+2605-2606,U+2713-2718,U+27E8-27E9"
more="$more,U+2A7D-2A7E,U+2C7C,U+FFFD"

subset() {
    pyftsubset "$full/$1.ttf" --unicodes="$2" --output-file="$here/$1-subset.ttf" \
        --layout-features='' --no-hinting --notdef-outline --name-IDs='0,1,2,3,4,5,6,13,14' \
        --drop-tables+=GSUB,GPOS,GDEF,MATH,kern,FFTM,gasp
}

subset DejaVuSans "$letters,$signs,$math,$more"
subset DejaVuSans-Bold "$letters,$signs,$math"
