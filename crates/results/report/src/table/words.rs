//! Text with optional spellings for each format.

use taceva_metrics::Better;

use crate::escape;

/// Text of a table. Each format escapes the text, or uses the spelling that is set for the format.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words {
    plain: String,
    markdown: Option<String>,
    latex: Option<String>,
}

impl Words {
    /// Text that every format escapes.
    pub fn new(plain: impl Into<String>) -> Words {
        Words {
            plain: plain.into(),
            markdown: None,
            latex: None,
        }
    }

    /// Name such as `r_spatial`. Markdown prints it unescaped if it consists of letters, digits and joiners.
    pub fn name(plain: impl Into<String>) -> Words {
        let plain = plain.into();
        let is_name =
            |letter: char| letter.is_alphanumeric() || matches!(letter, '_' | '.' | '-' | ':');
        Words {
            markdown: plain.chars().all(is_name).then(|| plain.clone()),
            ..Words::new(plain)
        }
    }

    /// Sets the LaTeX spelling.
    #[must_use]
    pub fn latex(self, latex: impl Into<String>) -> Words {
        Words {
            latex: Some(latex.into()),
            ..self
        }
    }

    /// Sets the Markdown spelling.
    #[must_use]
    pub fn markdown(self, markdown: impl Into<String>) -> Words {
        Words {
            markdown: Some(markdown.into()),
            ..self
        }
    }

    /// Text without the spellings of formats.
    pub fn plain(&self) -> &str {
        &self.plain
    }

    /// Appends the sign of a direction, unless the text is empty.
    pub(super) fn directed(self, better: Option<Better>) -> Words {
        match better {
            Some(better) if !self.plain.is_empty() => Words {
                plain: better.beside(&self.plain),
                markdown: self.markdown.map(|markdown| better.beside(&markdown)),
                latex: (self.latex).map(|latex| latex + &escape::latex(&better.beside(""))),
            },
            _ => self,
        }
    }

    pub(super) fn in_markdown(&self) -> String {
        let own = self.markdown.clone();
        own.unwrap_or_else(|| escape::markdown(&self.plain))
    }

    pub(crate) fn in_latex(&self) -> String {
        let own = self.latex.clone();
        own.unwrap_or_else(|| super::latex::number(&self.plain))
    }
}

impl From<String> for Words {
    fn from(plain: String) -> Words {
        Words::new(plain)
    }
}

impl From<&str> for Words {
    fn from(plain: &str) -> Words {
        Words::new(plain)
    }
}
