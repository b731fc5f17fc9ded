//! Values by name, in an order.

use std::fmt;
use std::marker::PhantomData;
use std::ops::Index;
use std::sync::Arc;

use indexmap::IndexSet;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde::ser::{Serialize, Serializer};

/// An ordered map from names to values, written as a JSON object.
///
/// Maps may share their names ([`Named::of`]): hundreds of modes of hundreds of shafts hold the names of the
/// shafts once.
#[derive(Clone, PartialEq)]
pub struct Named<T> {
    names: Names,
    values: Vec<T>,
}

/// Different names in an order, for maps that share them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names(Arc<IndexSet<String>>);

impl<S: Into<String>> FromIterator<S> for Names {
    fn from_iter<I: IntoIterator<Item = S>>(names: I) -> Self {
        Self(Arc::new(names.into_iter().map(Into::into).collect()))
    }
}

impl<T> Named<T> {
    /// A value for each name; `None` where there are not as many.
    pub fn of(names: &Names, values: Vec<T>) -> Option<Self> {
        (names.0.len() == values.len()).then(|| Self { names: names.clone(), values })
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The value of that name.
    pub fn get(&self, name: &str) -> Option<&T> {
        self.values.get(self.names.0.get_index_of(name)?)
    }

    /// The value of that name, to be changed.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut T> {
        self.values.get_mut(self.names.0.get_index_of(name)?)
    }

    /// Whether something has that name.
    pub fn contains_key(&self, name: &str) -> bool {
        self.names.0.contains(name)
    }

    /// Gives a value that name, in the place of an older one or at the end; returns the older one.
    pub fn insert(&mut self, name: String, value: T) -> Option<T> {
        let (place, new) = Arc::make_mut(&mut self.names.0).insert_full(name);
        if new {
            self.values.push(value);
            return None;
        }
        self.values.get_mut(place).map(|old| std::mem::replace(old, value))
    }

    /// Keeps the pairs that `wanted` says yes to, in their order.
    pub fn retain(&mut self, mut wanted: impl FnMut(&str, &T) -> bool) {
        let pairs = std::mem::take(self).into_iter();
        *self = pairs.filter(|(name, value)| wanted(name, value)).collect();
    }

    /// Name and value of that name.
    pub fn get_key_value(&self, name: &str) -> Option<(&String, &T)> {
        let (place, name) = self.names.0.get_full(name)?;
        Some((name, self.values.get(place)?))
    }

    /// Names and values in their order.
    pub fn iter(&self) -> Iter<'_, T> {
        self.names.0.iter().zip(&self.values)
    }

    /// Names and values in their order, these to be changed.
    pub fn iter_mut(&mut self) -> IterMut<'_, T> {
        self.names.0.iter().zip(&mut self.values)
    }

    /// The first of them.
    pub fn first(&self) -> Option<(&String, &T)> {
        self.iter().next()
    }

    /// The names in their order.
    pub fn keys(&self) -> indexmap::set::Iter<'_, String> {
        self.names.0.iter()
    }

    /// The values in their order.
    pub fn values(&self) -> std::slice::Iter<'_, T> {
        self.values.iter()
    }

    /// The values in their order, without the names.
    pub fn into_values(self) -> std::vec::IntoIter<T> {
        self.values.into_iter()
    }

    /// The values in their order, to be changed.
    pub fn values_mut(&mut self) -> std::slice::IterMut<'_, T> {
        self.values.iter_mut()
    }
}

/// Names with values.
pub type Iter<'n, T> = std::iter::Zip<indexmap::set::Iter<'n, String>, std::slice::Iter<'n, T>>;

/// Names with values to be changed.
pub type IterMut<'n, T> =
    std::iter::Zip<indexmap::set::Iter<'n, String>, std::slice::IterMut<'n, T>>;

impl<T> Default for Named<T> {
    fn default() -> Self {
        Self { names: Names::default(), values: Vec::new() }
    }
}

impl<T: fmt::Debug> fmt::Debug for Named<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self).finish()
    }
}

impl<T> Index<&str> for Named<T> {
    type Output = T;

    /// # Panics
    ///
    /// Where nothing has that name.
    #[expect(clippy::expect_used, reason = "an index says that it is there; `get` asks")]
    fn index(&self, name: &str) -> &T {
        self.get(name).expect("a value of that name")
    }
}

impl<T> Extend<(String, T)> for Named<T> {
    fn extend<I: IntoIterator<Item = (String, T)>>(&mut self, pairs: I) {
        for (name, value) in pairs {
            self.insert(name, value);
        }
    }
}

impl<T> FromIterator<(String, T)> for Named<T> {
    fn from_iter<I: IntoIterator<Item = (String, T)>>(pairs: I) -> Self {
        let mut named = Self::default();
        named.extend(pairs);
        named
    }
}

impl<T, const N: usize> From<[(String, T); N]> for Named<T> {
    fn from(pairs: [(String, T); N]) -> Self {
        pairs.into_iter().collect()
    }
}

impl<'n, T> IntoIterator for &'n Named<T> {
    type Item = (&'n String, &'n T);
    type IntoIter = Iter<'n, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'n, T> IntoIterator for &'n mut Named<T> {
    type Item = (&'n String, &'n mut T);
    type IntoIter = IterMut<'n, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}

impl<T> IntoIterator for Named<T> {
    type Item = (String, T);
    type IntoIter = std::iter::Zip<indexmap::set::IntoIter<String>, std::vec::IntoIter<T>>;

    fn into_iter(self) -> Self::IntoIter {
        Arc::unwrap_or_clone(self.names.0).into_iter().zip(self.values)
    }
}

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Map<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Map<T> {
            type Value = Named<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named<T>, A::Error> {
                let mut named = Named::default();
                while let Some((name, value)) = map.next_entry()? {
                    named.insert(name, value);
                }
                Ok(named)
            }
        }
        deserializer.deserialize_map(Map(PhantomData))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_shared_until_one_of_the_maps_changes() {
        let names: Names = ["b", "a"].into_iter().collect();
        let first = Named::of(&names, vec![1.0, 2.0]).unwrap();
        let mut second = first.clone();
        assert!(Arc::ptr_eq(&first.names.0, &second.names.0));
        assert_eq!(second.insert("c".to_owned(), 3.0), None);
        assert_eq!(second.insert("b".to_owned(), 4.0), Some(1.0));
        assert_eq!(
            second.iter().map(|(n, v)| (n.as_str(), *v)).collect::<Vec<_>>(),
            [("b", 4.0), ("a", 2.0), ("c", 3.0)]
        );
        assert_eq!((first["a"], first.len(), first.get("c")), (2.0, 2, None));
        assert_eq!(Named::of(&names, vec![1.0]), None);
    }

    #[test]
    fn a_map_is_an_object_in_its_order() {
        let map: Named<f64> = serde_json::from_str(r#"{"z": 1.5, "a": 2.5, "z": 3.5}"#).unwrap();
        assert_eq!(serde_json::to_string(&map).unwrap(), r#"{"z":3.5,"a":2.5}"#);
        assert!(serde_json::from_str::<Named<f64>>("[1.0]").is_err());
    }
}
