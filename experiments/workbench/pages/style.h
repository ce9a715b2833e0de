// How every page of results looks and moves: one style and one script, written into each page.
#pragma once

namespace hysteron::experiments {

// CSS for light and dark screens, phones and paper.
const char* page_style();

// JavaScript for `.player` (a sequence of figures: play, step) and `a.zoom` (the full picture over the page).
// Without it a sequence is a strip and a picture a link.
const char* page_script();

}  // namespace hysteron::experiments
