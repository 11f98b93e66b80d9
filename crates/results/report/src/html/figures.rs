//! Figures of a report with their captions.

use maud::{Markup, PreEscaped, html};

use crate::figure::Figure;

/// Figure with title and caption.
pub(crate) fn one(figure: &Figure) -> Markup {
    html! {
        figure id={ "figure-" (figure.id) } { h3 { (figure.title) } "\n" (drawing(figure)) figcaption { (figure.caption) } } "\n"
    }
}

/// Figure without caption.
pub(super) fn drawing(figure: &Figure) -> Markup {
    // SVG is XML, where empty elements differ from HTML. Its writer escapes all text.
    PreEscaped(figure.inline())
}

/// Shows the radar charts of `figures` side by side; `None` without radar charts.
pub(crate) fn radars(figures: &[Figure]) -> Option<Markup> {
    let radars: Vec<&Figure> = figures.iter().filter(|drawn| is_radar(drawn)).collect();
    (!radars.is_empty())
        .then(|| html! { div.radars { @for radar in radars { (one(radar)) } } "\n" })
}

/// True for radar charts, which belong to the overview of sensors.
pub(super) fn is_radar(figure: &Figure) -> bool {
    figure.id.starts_with("radar")
}
