//! Tables as JSON.

use serde_json::{Value, json};

use super::Table;

impl Table {
    /// JSON with the schema `schema`: rows as objects by column name.
    pub fn json(&self, schema: &str) -> String {
        let (head, rows) = self.for_programs();
        let rows = rows.iter().map(|row| {
            let cells = head.iter().zip(row);
            let cells = cells.map(|(name, cell)| {
                let text = cell
                    .exact_text()
                    .map_or_else(|| cell.plain(), str::to_owned);
                (name.clone(), Value::from(text))
            });
            Value::Object(cells.collect())
        });
        let rows: Vec<Value> = rows.collect();
        let notes: Vec<&str> = self.notes.iter().map(|note| note.plain()).collect();
        let whole = json!({
            "schema": schema,
            "caption": self.caption,
            "rows": rows,
            "notes": notes,
        });
        format!("{whole:#}\n")
    }
}
