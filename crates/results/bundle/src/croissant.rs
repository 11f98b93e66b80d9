//! Description of a bundle as a Croissant 1.0: its files with digests, its tables as record sets, its claims.

use serde_json::{Value, json};

use crate::claim::properties;
use crate::columns::{Column, TableColumns};
use crate::manifest::{BundledFile, Manifest, licence_address};

/// Terms of the published context that Croissant defines without a type.
const TERMS: [&str; 26] = [
    "citeAs",
    "column",
    "equivalentProperty",
    "extract",
    "field",
    "fileObject",
    "fileProperty",
    "fileSet",
    "format",
    "includes",
    "isLiveDataset",
    "jsonPath",
    "key",
    "md5",
    "parentField",
    "path",
    "recordSet",
    "references",
    "regex",
    "repeated",
    "replace",
    "samplingRate",
    "separator",
    "source",
    "subField",
    "transform",
];

/// Beginning of the identifier of a numbered column.
const NUMBERED: &str = "column-";

/// Text of `croissant.json`; `tables` become its record sets.
pub(crate) fn text(manifest: &Manifest, tables: &[TableColumns]) -> String {
    let licences = manifest.licence.as_slice();
    let own = dataset(manifest, &manifest.description(), licences, tables);
    format!("{own:#}\n")
}

/// The files of `manifest` as a dataset with this description and these licences.
pub(crate) fn dataset(
    manifest: &Manifest,
    description: &str,
    licences: &[String],
    tables: &[TableColumns],
) -> Value {
    let files: Vec<Value> = manifest.given_files().map(file).collect();
    let records: Vec<Value> = tables.iter().map(record_set).collect();
    let mut own = json!({
        "@context": context(),
        "@type": "sc:Dataset",
        "conformsTo": "http://mlcommons.org/croissant/1.0",
        "name": manifest.name,
        "description": description,
        "version": "1.0.0",
        "datePublished": manifest.created,
        "citeAs": cited(manifest),
        "distribution": files,
        "recordSet": records,
        "variableMeasured": properties(&manifest.claims),
    });
    let authors = manifest.authors.iter().map(|author| {
        let mut own = json!({"@type": "sc:Person", "name": author.name});
        if let Some(address) = author.address() {
            own["url"] = address.into();
        }
        own
    });
    let authors: Vec<Value> = authors.collect();
    if !authors.is_empty() {
        own["creator"] = authors.into();
    }
    let mut addresses: Vec<Value> = licences
        .iter()
        .map(|licence| licence_address(licence).into())
        .collect();
    match addresses.len() {
        0 => {}
        1 => own["license"] = addresses.remove(0),
        _ => own["license"] = addresses.into(),
    }
    if let Some(organization) = &manifest.organization {
        let (name, url) = (&organization.name, &organization.url);
        own["publisher"] = json!({"@type": "sc:Organization", "name": name, "url": url});
        own["url"] = url.as_str().into();
    }
    own
}

/// The published context of Croissant 1.0.
fn context() -> Value {
    let mut own = json!({
        "@language": "en",
        "@vocab": "https://schema.org/",
        "sc": "https://schema.org/",
        "cr": "http://mlcommons.org/croissant/",
        "rai": "http://mlcommons.org/croissant/RAI/",
        "dct": "http://purl.org/dc/terms/",
        "conformsTo": "dct:conformsTo",
        "data": {"@id": "cr:data", "@type": "@json"},
        "dataType": {"@id": "cr:dataType", "@type": "@vocab"},
        "examples": {"@id": "cr:examples", "@type": "@json"},
    });
    for term in TERMS {
        own[term] = format!("cr:{term}").into();
    }
    own
}

/// Citation: authors, year and name.
fn cited(manifest: &Manifest) -> String {
    let names = manifest.authors.iter().map(|author| author.name.as_str());
    let names: Vec<&str> = names.collect();
    let authors = match names.as_slice() {
        [] => "Authors not stated".to_owned(),
        names => names.join(", "),
    };
    let year = manifest.created.split('-').next().unwrap_or_default();
    format!("{authors} ({year}): {}", manifest.name)
}

fn file(file: &BundledFile) -> Value {
    json!({
        "@type": "cr:FileObject",
        "@id": file.path,
        "name": file.path,
        "description": file.role,
        "contentUrl": file.path,
        "contentSize": format!("{} B", file.size),
        "encodingFormat": file.media_type(),
        "sha256": file.digits(),
    })
}

fn record_set(table: &TableColumns) -> Value {
    let name = table.path.rsplit('/').next().unwrap_or_default();
    let name = name.split('.').next().unwrap_or_default();
    let columns = table.columns.iter().enumerate();
    let fields = columns.map(|(position, column)| field(table, name, position, column));
    let fields: Vec<Value> = fields.collect();
    json!({
        "@type": "cr:RecordSet",
        "@id": name,
        "name": name,
        "field": fields,
    })
}

/// Field of a column. Identifiers contain only letters, digits, `_`, `.` and `-`, so a column with another name is numbered. Names that begin like a
/// numbered column are also numbered.
fn field(table: &TableColumns, record_set: &str, position: usize, column: &Column) -> Value {
    let is_plain = |letter: char| letter.is_alphanumeric() || "_.-".contains(letter);
    let is_numbered = column.name.starts_with(NUMBERED) || !column.name.chars().all(is_plain);
    let id = match is_numbered {
        true => format!("{record_set}/{NUMBERED}{position}"),
        false => format!("{record_set}/{}", column.name),
    };
    json!({
        "@type": "cr:Field",
        "@id": id,
        "name": id,
        "description": column.name,
        "dataType": column.data_type,
        "source": {
            "fileObject": {"@id": table.path},
            "extract": {"column": column.name},
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_columns_share_an_identifier() {
        let columns = ["Fz", "my x", "column-1"].map(|name| Column {
            name: name.to_owned(),
            data_type: "sc:Float",
        });
        let table = TableColumns {
            path: "tables/truth.csv".to_owned(),
            columns: columns.into(),
        };
        let set = record_set(&table);
        let fields = set["field"].as_array().expect("fields").iter();
        let ids: Vec<&Value> = fields.map(|field| &field["@id"]).collect();
        assert_eq!(ids, ["truth/Fz", "truth/column-1", "truth/column-2"]);
    }
}
