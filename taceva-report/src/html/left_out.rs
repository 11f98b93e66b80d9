//! What was left out, and what a reader must mind.

use crate::escape::html;
use crate::figures::names;
use crate::results::Study;

/// The rows of what was left out, and how many there are.
pub(super) fn section(studies: &[Study]) -> (usize, String) {
    let (mut count, mut rows) = (0, String::new());
    for (study, name) in studies.iter().zip(names(studies)) {
        let name = html(&name);
        let mut row = |kind: &str, what: &str, why: &str| {
            count += 1;
            rows += &format!(
                "<tr><th scope=\"row\">{name}</th><td>{kind}</td><td class=\"wrap\">{}</td><td class=\"wrap long\">{}</td></tr>\n",
                html(what),
                html(why)
            );
        };
        for skip in &study.skipped {
            row("skipped", &skip.what, &skip.reason);
        }
        for score in &study.scores {
            let what = format!("{} {}", score.metric, score.channel);
            if let Some(reason) = score.value.reason() {
                row("no value", &what, &reason);
            }
            for flag in &score.flags {
                row("mind", &what, flag);
            }
        }
        for note in &study.notes {
            row("note", "", note);
        }
    }
    if rows.is_empty() {
        let nothing =
            "<p>Nothing was skipped, every score has a value, and no remark was made.</p>";
        return (0, nothing.to_owned());
    }
    let table = format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"What was left out\"><table class=\"sorts\"><thead><tr><th scope=\"col\">sensor</th><th scope=\"col\">kind</th>\
         <th scope=\"col\">what</th><th scope=\"col\">why</th></tr></thead><tbody>\n{rows}</tbody></table></div>"
    );
    (count, table)
}
