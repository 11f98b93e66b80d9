//! Page with paragraphs, tables and figures of the caller.

use maud::{Markup, html};

use crate::figure::Figure;
use crate::html::Document;
use crate::markup::fold;
use crate::table::Table;

/// Page of paragraphs, tables and figures.
///
/// ```
/// use taceva_report::{PagePart, PageSection, Table, TablesPage};
/// let mut table = Table::new("Tasks", ["model"]);
/// table.push(["<b>"]);
/// let page = TablesPage {
///     title: "Which network?".to_owned(),
///     badge: Some("Nothing here was measured.".to_owned()),
///     lead: vec!["Two models.".to_owned()],
///     sections: vec![PageSection { id: "tasks", title: "Tasks", parts: vec![PagePart::Table(table)] }],
/// };
/// assert!(page.html().contains("&lt;b&gt;"));
/// ```
#[derive(Clone, Debug)]
pub struct TablesPage {
    /// Title of the page.
    pub title: String,
    /// Badge for an important fact, such as simulated samples; `None` for no badge.
    pub badge: Option<String>,
    /// Sentences below the title.
    pub lead: Vec<String>,
    /// Sections of the page.
    pub sections: Vec<PageSection>,
}

/// Section of a page.
#[derive(Clone, Debug)]
pub struct PageSection {
    /// Id of the section for links; a single word.
    pub id: &'static str,
    /// Title of the section.
    pub title: &'static str,
    /// Content of the section.
    pub parts: Vec<PagePart>,
}

/// Part of a section.
#[derive(Clone, Debug)]
pub enum PagePart {
    /// A paragraph.
    Words(String),
    /// A table.
    Table(Table),
    /// A folded table: link id, size as text, and table.
    Folded(&'static str, String, Table),
    /// A figure with its caption.
    Figure(Box<Figure>),
}

impl TablesPage {
    /// HTML file without network access.
    pub fn html(self) -> String {
        let lead = html! {
            @for sentence in &self.lead { p.lead { (sentence) } "\n" }
            @if let Some(badge) = &self.badge { p.badge { (badge) } "\n" }
        };
        let mut document = Document::new(&self.title, lead);
        for section in self.sections {
            let body = html! { @for part in &section.parts { (part.html()) } };
            document.section(section.id, section.title, body);
        }
        document.finish()
    }
}

impl PagePart {
    fn html(&self) -> Markup {
        match self {
            PagePart::Words(words) => html! { p { (words) } "\n" },
            PagePart::Table(table) => table.html(),
            PagePart::Folded(id, holds, table) => fold(id, &table.caption, holds, &table.html()),
            PagePart::Figure(figure) => crate::html::drawn(figure),
        }
    }
}
