//! Folds of a cross-validation, read from the provenance of a result.

use taceva_core::counted;

use crate::provenance::Provenance;

impl Provenance {
    /// Description of the cross-validation that gave the scores. `None` if one model was fitted, and tested on other samples.
    ///
    /// ```
    /// use taceva_results::Provenance;
    /// let mut made = Provenance::default();
    /// made.split = Some("cv:5 by-column:video".to_owned());
    /// made.part = Some("test".to_owned());
    /// assert_eq!(made.cross_validation().as_deref(), Some("5-fold cross-validation by video"));
    /// assert_eq!(made.fold_models(), Some(5));
    /// ```
    pub fn cross_validation(&self) -> Option<String> {
        let split = self.split.as_deref()?;
        let fitted = self.samples.get("train").copied().unwrap_or_default();
        if fitted > 0 || self.part.as_deref() != Some("test") {
            return None;
        }
        let (word, by) = split.split_once(' ').unwrap_or((split, ""));
        let group = match by {
            "random" => "sample",
            by => by
                .strip_prefix("by-column:")
                .or_else(|| by.strip_prefix("by-"))
                .unwrap_or_default(),
        };
        let by = match group {
            "" => String::new(),
            group => format!(" by {group}"),
        };
        match (word, word.strip_prefix("cv:")) {
            ("leave-one-recording-out", _) => Some("cross-validation by recording".to_owned()),
            ("loo", _) => Some(format!("leave-one-out cross-validation{by}")),
            (_, Some(count)) => Some(format!("{count}-fold cross-validation{by}")),
            _ => None,
        }
    }

    /// Phrase with the number of test samples and of models of a [cross-validation](Provenance::cross_validation); `None` without a cross-validation.
    ///
    /// ```
    /// use taceva_results::Provenance;
    /// let mut made = Provenance::default();
    /// made.split = Some("cv:5 random".to_owned());
    /// made.part = Some("test".to_owned());
    /// made.samples.insert("test".to_owned(), 460);
    /// let words = "460 samples, each predicted once by one of 5 models";
    /// assert_eq!(made.predicted_once().as_deref(), Some(words));
    /// ```
    pub fn predicted_once(&self) -> Option<String> {
        self.cross_validation()?;
        let tested = counted(*self.samples.get("test")?, "sample");
        let models = match self.fold_models() {
            Some(models) => format!("one of {models} models"),
            None => "a model that has not seen its group".to_owned(),
        };
        let left_out = match self.samples.get("left_out") {
            None | Some(0) => String::new(),
            Some(count) => format!("; left out {count}"),
        };
        Some(format!(
            "{tested}, each predicted once by {models}{left_out}"
        ))
    }

    /// Number of models that the [cross-validation](Provenance::cross_validation) fitted. `None` if the provenance does not state the number.
    pub fn fold_models(&self) -> Option<usize> {
        self.cross_validation()?;
        let split = self.split.as_deref()?;
        let word = split.split(' ').next()?;
        match word.strip_prefix("cv:") {
            Some(count) => count.parse().ok(),
            None => Some(self.recordings.len())
                .filter(|count| *count > 0 && word == "leave-one-recording-out"),
        }
    }
}

impl Provenance {
    /// Kind of group that the split keeps in one part: a column such as `object`, or `block of time`. Intervals leave out these groups one by one.
    /// `None` for other splits.
    ///
    /// ```
    /// use taceva_results::Provenance;
    /// let mut made = Provenance::default();
    /// made.split = Some("loo by-column:object".to_owned());
    /// assert_eq!(made.group(), Some("object"));
    /// ```
    pub fn group(&self) -> Option<&str> {
        match kept_together(self.split.as_deref()?) {
            "by-block" => Some("block of time"),
            by => by.strip_prefix("by-column:"),
        }
    }
}

/// Removes fold count, shares and named parts from the text of a split, such as `by-point 70/20/10`. The rest names the groups that are not divided.
///
/// ```
/// assert_eq!(taceva_results::kept_together("cv:5 by-column:object"), "by-column:object");
/// assert_eq!(taceva_results::kept_together("by-point 70/20/10"), "by-point");
/// ```
pub fn kept_together(split: &str) -> &str {
    let shares = split.rsplit_once(' ');
    let are_shares = |text: &str| {
        let numbers: Result<Vec<f64>, _> = text.split('/').map(str::parse).collect();
        numbers.is_ok_and(|numbers| numbers.len() == 3)
    };
    let shares = shares.filter(|(_, last)| are_shares(last));
    let text = shares.map_or(split, |(text, _)| text);
    let text = match text.split_once(' ') {
        Some((word, by)) if word == "loo" || word.starts_with("cv:") => by,
        _ => text,
    };
    text.split('=').next().unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_of_folds_has_its_words_and_no_other_split_has() {
        let words = |split: &str, train: usize| {
            let made = Provenance {
                split: Some(split.to_owned()),
                part: Some("test".to_owned()),
                samples: [("test".to_owned(), 9), ("train".to_owned(), train)].into(),
                ..Provenance::default()
            };
            (made.cross_validation(), made.fold_models())
        };
        for (split, expected, models) in [
            ("cv:5", "5-fold cross-validation", Some(5)),
            ("cv:3 by-point", "3-fold cross-validation by point", Some(3)),
            (
                "cv:10 random",
                "10-fold cross-validation by sample",
                Some(10),
            ),
            (
                "loo by-column:object",
                "leave-one-out cross-validation by object",
                None,
            ),
            (
                "leave-one-recording-out 70/20/10",
                "cross-validation by recording",
                None,
            ),
        ] {
            assert_eq!(words(split, 0), (Some(expected.to_owned()), models));
            assert_eq!(words(split, 4), (None, None), "one model was fitted");
        }
        assert_eq!(words("by-point 70/20/10", 0), (None, None));
    }

    #[test]
    fn folds_and_shares_do_not_change_what_is_kept_together() {
        for (split, expected) in [
            ("cv:5 by-point", "by-point"),
            ("by-point 70/20/10", "by-point"),
            ("loo by-column:object", "by-column:object"),
            (
                "by-column:object=train:a,b;test:c 70/20/10",
                "by-column:object",
            ),
            (
                "leave-one-recording-out 70/20/10",
                "leave-one-recording-out",
            ),
            ("declared", "declared"),
            ("by-column:a b/c/d", "by-column:a b/c/d"),
        ] {
            assert_eq!(kept_together(split), expected);
        }
    }
}
