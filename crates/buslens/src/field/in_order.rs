use std::cmp::Ordering;

/// The items in the order of their keys, equal ones as they came.
///
/// The sorts of the standard library are compiled for each type that is sorted, 2 to 4 kB of the page each time. This
/// one sorts numbers of items for all of them; where the time that it takes is felt, theirs are the right ones.
pub fn in_order<T, K: Ord>(items: impl IntoIterator<Item = T>, key: impl Fn(&T) -> K) -> Vec<T> {
    in_order_by(items, |one, other| key(one).cmp(&key(other)))
}

/// The same with a comparison of their own.
pub fn in_order_by<T>(items: impl IntoIterator<Item = T>, compare: impl Fn(&T, &T) -> Ordering) -> Vec<T> {
    let items: Vec<T> = items.into_iter().collect();
    let order = order(items.len(), &mut |one, other| compare(&items[one], &items[other]));
    let mut items: Vec<Option<T>> = items.into_iter().map(Some).collect();
    order.into_iter().filter_map(|at| items[at].take()).collect()
}

/// Where the items of the order stand, compared by their places.
fn order(count: usize, compare: &mut dyn FnMut(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|one, other| compare(*one, *other));
    order
}

#[cfg(test)]
mod tests {
    use super::{in_order, in_order_by};

    #[test]
    fn equal_ones_stay_as_they_came() {
        let items = [(2, 'a'), (1, 'b'), (2, 'c'), (1, 'd')];
        assert_eq!(in_order(items, |(key, _)| *key), [(1, 'b'), (1, 'd'), (2, 'a'), (2, 'c')]);
        assert!(in_order(Vec::<u8>::new(), |key| *key).is_empty());
    }

    #[test]
    fn many_are_in_order() {
        let numbers: Vec<u64> = (0..1000).map(|n| n * 7919 % 1009).collect();
        let mut sorted = numbers.clone();
        sorted.sort_unstable();
        assert_eq!(in_order_by(numbers, Ord::cmp), sorted);
    }
}
