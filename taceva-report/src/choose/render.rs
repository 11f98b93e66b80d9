//! Choices as rows, as JSON and as a page.

use serde_json::json;

use super::{Candidate, Choice, Step};
use crate::escape::html;
use crate::html::Document;
use crate::listing::Listing;
use crate::number::fixed;

/// The schema of a choice as JSON.
pub const CHOICE_SCHEMA: &str = "taceva.choice/1";

impl Choice {
    /// A row a sensor, need and number; the best sensor first, those that were dropped last.
    pub fn listing(&self) -> Listing {
        let head = [
            "place",
            "sensor",
            "need",
            "looked at",
            "number",
            "share of the best",
            "mean share",
        ];
        let mut listing = Listing::new(&self.headline(), &head);
        for (at, candidate) in self.ranked.iter().enumerate() {
            for (number, step) in candidate.steps.iter().enumerate() {
                let is_first = number == 0;
                let once = |text: String| if is_first { text } else { String::new() };
                listing.rows.push(vec![
                    once((at + 1).to_string()),
                    once(candidate.name.clone()),
                    step.need.clone(),
                    step.property.to_string(),
                    shown(step),
                    step.share.map_or_else(String::new, |share| fixed(share, 2)),
                    once(fixed(candidate.share, 2)),
                ]);
            }
        }
        for dropped in &self.dropped {
            listing
                .notes
                .push(format!("Dropped: {}: {}.", dropped.name, dropped.reason));
        }
        if !self.unknown.is_empty() {
            listing.notes.push(format!(
                "Nothing is known of what is asked: {}.",
                self.unknown.join(", ")
            ));
        }
        listing
    }

    /// The answer in a sentence.
    pub fn headline(&self) -> String {
        match self.ranked.as_slice() {
            [] => "No sensor meets every need, as far as is known".to_owned(),
            [best] => format!("{} alone meets every need, as far as is known", best.name),
            [best, second, ..] => format!("{} first, {} second", best.name, second.name),
        }
    }

    /// As JSON of [`CHOICE_SCHEMA`].
    pub fn json(&self) -> String {
        let step = |step: &Step| {
            json!({
                "need": step.need,
                "looked_at": step.property.to_string(),
                "value": step.value,
                "unit": step.property.unit(),
                "share": step.share,
            })
        };
        let candidate = |candidate: &Candidate| {
            let steps: Vec<_> = candidate.steps.iter().map(step).collect();
            json!({"name": candidate.name, "share": candidate.share, "steps": steps})
        };
        let ranked: Vec<_> = self.ranked.iter().map(candidate).collect();
        let dropped = self.dropped.iter();
        let dropped: Vec<_> = dropped
            .map(|dropped| json!({"name": dropped.name, "reason": dropped.reason}))
            .collect();
        let whole = json!({"schema": CHOICE_SCHEMA, "ranked": ranked, "dropped": dropped, "unknown": self.unknown});
        format!("{whole:#}\n")
    }

    /// As a page.
    pub fn page(&self, needs: &str) -> String {
        let mut document = Document::new("Which sensor?");
        document.lead(&format!("<p class=\"lead\">Needs: {}</p>", html(needs)));
        let answer = format!("<p><strong>{}.</strong></p>", html(&self.headline()));
        document.section("answer", "Answer", &answer);
        let mut listing = self.listing();
        "Every number that was looked at".clone_into(&mut listing.caption);
        document.section("steps", "How it came about", &listing.html());
        document.finish()
    }
}

fn shown(step: &Step) -> String {
    step.value.map_or_else(
        || "not known".to_owned(),
        |value| step.property.shown(value),
    )
}
