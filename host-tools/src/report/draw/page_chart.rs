//! A chart in a page.

use maud::{Markup, html};

use super::px;

/// A chart as wide as the page; on a narrow screen it keeps a width at which it can be read, and moves under the finger. `words` say what
/// it shows to those who do not see it.
pub fn page_chart((width, height): (f64, f64), words: &str, content: &Markup) -> Markup {
    html! {
        div class="scroll" {
            svg class="chart" viewBox={ "0 0 " (px(width)) " " (px(height)) } role="img" aria-label=(words) { (content) }
        }
    }
}
