//! The Pareto front: what nothing else beats in time and error both.

/// Those of some points that no other equals or beats in both coordinates, by their indices, from
/// the left down to the right. Of equal points the first counts.
pub(super) fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<_> = (0..points.len()).collect();
    let (x, y) = (|i: usize| points[i].0, |i: usize| points[i].1);
    order.sort_by(|&a, &b| x(a).total_cmp(&x(b)).then(y(a).total_cmp(&y(b))));
    let mut least = None;
    order.retain(|&i| {
        let better = least.is_none_or(|least| y(i) < least);
        if better {
            least = Some(y(i));
        }
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn only_the_unbeaten_are_on_it_fastest_first() {
        let points = [(3.0, 0.0), (1.0, 9.0), (2.0, 9.0), (2.0, 5.0), (2.5, 6.0), (4.0, 0.0)];
        assert_eq!(front(&points), [1, 3, 0]);
    }

    #[test]
    fn of_equal_points_the_first_counts() {
        assert_eq!(front(&[(1.0, 1.0), (1.0, 1.0)]), [0]);
        assert_eq!(front(&[(1.0, 2.0), (1.0, 1.0)]), [1]);
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn what_errs_without_bound_may_be_the_fastest() {
        assert_eq!(front(&[(1.0, f64::INFINITY), (2.0, 1.0)]), [0, 1]);
    }
}
