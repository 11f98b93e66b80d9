//! Dimensions of a sweep: splits, models with their own settings, and settings.

use std::collections::BTreeSet;

use crate::task::Task;
use crate::task_list::TaskList;

/// One dimension of a sweep, with its values in the order of the file.
pub(super) struct Dimension {
    what: What,
    pub(super) values: Vec<String>,
    /// Settings in `[vary]`, which apply to every model.
    shared: BTreeSet<String>,
}

enum What {
    Split,
    /// Models with their model-specific settings.
    Model,
    /// A setting that applies to every model.
    Shared(String),
    /// A setting of one model with more than one value in the sweep file.
    Own {
        model: String,
        key: String,
    },
}

pub(super) fn dimensions(list: &TaskList) -> Vec<Dimension> {
    let shared: BTreeSet<String> = list.vary.iter().map(|(key, _)| key.clone()).collect();
    let mut whats = vec![What::Split, What::Model];
    whats.extend(list.vary.iter().map(|(key, _)| What::Shared(key.clone())));
    let mut own = Vec::new();
    for task in &list.tasks {
        for key in task.settings.keys().filter(|key| !shared.contains(*key)) {
            let of = (task.model.clone(), key.clone());
            if !own.contains(&of) {
                own.push(of);
            }
        }
    }
    whats.extend(own.into_iter().map(|(model, key)| What::Own { model, key }));
    let dimensions = whats.into_iter().map(|what| {
        let mut dimension = Dimension {
            what,
            values: Vec::new(),
            shared: shared.clone(),
        };
        for task in &list.tasks {
            let word = dimension.word(task);
            if let Some(word) = word.filter(|word| !dimension.values.contains(word)) {
                dimension.values.push(word);
            }
        }
        dimension
    });
    dimensions
        .filter(|dimension| dimension.values.len() > 1)
        .collect()
}

impl Dimension {
    /// Name of the dimension.
    pub(super) fn title(&self) -> String {
        match &self.what {
            What::Split => "split".to_owned(),
            What::Model => "model".to_owned(),
            What::Shared(key) => key.clone(),
            What::Own { model, key } => format!("{key} of {model}"),
        }
    }

    /// Value of the dimension for a task; `None` if the dimension does not apply to the task.
    pub(super) fn word(&self, task: &Task) -> Option<String> {
        match &self.what {
            What::Split => task.split.clone(),
            What::Model => Some(format!("{}{}", task.model, self.own_settings(task, None))),
            What::Shared(key) => task.settings.get(key).cloned(),
            What::Own { model, key } if *model == task.model => task.settings.get(key).cloned(),
            What::Own { .. } => None,
        }
    }

    /// All properties of a task except this dimension, as text. Tasks with equal text form a pair.
    pub(super) fn beside(&self, task: &Task) -> String {
        let split = match self.what {
            What::Split => None,
            _ => task.split.as_deref(),
        };
        let (model, own) = match &self.what {
            What::Model => ("", String::new()),
            What::Own { key, .. } => (task.model.as_str(), self.own_settings(task, Some(key))),
            _ => (task.model.as_str(), self.own_settings(task, None)),
        };
        let shared = task.settings.iter().filter(|(key, _)| {
            self.shared.contains(*key) && !matches!(&self.what, What::Shared(own) if own == *key)
        });
        let shared: String = shared
            .map(|(key, value)| format!(" {key}={value}"))
            .collect();
        format!(
            "{}|{}|{model}{own}|{shared}|{}",
            task.dataset,
            split.unwrap_or_default(),
            task.seed
        )
    }

    /// Model-specific settings of a task as text, without the setting `but`.
    fn own_settings(&self, task: &Task, but: Option<&str>) -> String {
        let own = task
            .settings
            .iter()
            .filter(|(key, _)| !self.shared.contains(*key) && but != Some(key.as_str()));
        own.map(|(key, value)| format!(" {key}={value}")).collect()
    }
}
