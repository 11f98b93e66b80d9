//! Members of a JSON object in file order, which a parsed map does not preserve.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_json::Value;

/// Members of the object at `pointer`; `None` if a value on the path is not an object.
pub(super) fn in_order(text: &str, pointer: &str) -> Option<Vec<(String, Value)>> {
    let parts = pointer.split('/').skip(1);
    let way: Vec<String> = parts
        .map(|part| part.replace("~1", "/").replace("~0", "~"))
        .collect();
    let mut deserializer = serde_json::Deserializer::from_str(text);
    Way(&way).deserialize(&mut deserializer).ok()?
}

/// Names of the members on the path to the wanted object.
struct Way<'w>(&'w [String]);

impl<'de> DeserializeSeed<'de> for Way<'_> {
    type Value = Option<Vec<(String, Value)>>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Way<'_> {
    type Value = Option<Vec<(String, Value)>>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Self::Value, A::Error> {
        let Some((next, behind)) = self.0.split_first() else {
            let mut all = Vec::new();
            while let Some(member) = members.next_entry()? {
                all.push(member);
            }
            return Ok(Some(all));
        };
        let mut found = None;
        while let Some(name) = members.next_key::<String>()? {
            match name == *next {
                true => found = members.next_value_seed(Way(behind))?,
                false => drop(members.next_value::<IgnoredAny>()?),
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_keep_the_order_of_the_file_behind_any_names() {
        let names = |text, pointer| {
            let members = in_order(text, pointer)?;
            Some(
                members
                    .into_iter()
                    .map(|(name, _)| name)
                    .collect::<Vec<String>>(),
            )
        };
        let list = |names: &[&str]| Some(names.iter().map(|name| (*name).to_owned()).collect());
        assert_eq!(
            names(r#"{"2": 1, "10": 2, "1": 3}"#, ""),
            list(&["2", "10", "1"])
        );
        assert_eq!(
            names(r#"{"x": 1, "a/b": {"z": {}, "y": 2}}"#, "/a~1b"),
            list(&["z", "y"])
        );
        assert_eq!(names(r#"{"a": [1]}"#, "/a"), None);
        assert_eq!(names(r#"{"a": {}}"#, "/b"), None);
        assert_eq!(names("[1]", ""), None);
    }
}
