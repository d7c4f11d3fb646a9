(* Derivatives along a flow, for the exported certificates that speak of rates and motions. *)
Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
Require Import Workbench.
Open Scope R_scope.

Lemma D_const : forall c t : R, is_derive (fun _ => c) t 0.
Proof. intros. apply (is_derive_const c t). Qed.

Lemma D_plus : forall (f g : R -> R) (t a b : R),
  is_derive f t a -> is_derive g t b -> is_derive (fun s => f s + g s) t (a + b).
Proof. intros. apply (is_derive_plus f g t a b); assumption. Qed.

Lemma D_minus : forall (f g : R -> R) (t a b : R),
  is_derive f t a -> is_derive g t b -> is_derive (fun s => f s - g s) t (a - b).
Proof. intros. apply (is_derive_minus f g t a b); assumption. Qed.

Lemma D_opp : forall (f : R -> R) (t a : R), is_derive f t a -> is_derive (fun s => - f s) t (- a).
Proof. intros. apply (is_derive_opp f t a); assumption. Qed.

Lemma D_mult : forall (f g : R -> R) (t a b : R),
  is_derive f t a -> is_derive g t b -> is_derive (fun s => f s * g s) t (a * g t + f t * b).
Proof. intros. apply (is_derive_mult f g t a b); try assumption. intros; unfold mult; simpl; ring. Qed.

Lemma D_same : forall (f : R -> R) (t a b : R), is_derive f t a -> a = b -> is_derive f t b.
Proof. intros. subst. assumption. Qed.

Lemma D_scale : forall (f : R -> R) (c t a : R), is_derive f t a -> is_derive (fun s => c * f s) t (c * a).
Proof. intros. apply (D_same _ t (0 * f t + c * a)); [|ring]. apply D_mult; [apply D_const|assumption]. Qed.

Lemma D_divide : forall (f g : R -> R) (t a b : R), is_derive f t a -> is_derive g t b -> g t <> 0 ->
  is_derive (fun s => f s / g s) t ((a * g t - f t * b) / (g t * g t)).
Proof.
  intros f g t a b F G N. apply (D_same _ t ((a * g t - f t * b) / (g t) ^ 2)).
  - apply (is_derive_div f g t a b); assumption.
  - field. assumption.
Qed.

Lemma D_divide_const : forall (f : R -> R) (c t a : R), is_derive f t a -> is_derive (fun s => f s / c) t (a / c).
Proof.
  intros. unfold Rdiv. apply (D_same _ t (a * / c + f t * 0)); [|ring].
  apply (D_mult f (fun _ => / c)); [assumption|apply D_const].
Qed.

Lemma D_power : forall (m : nat) (k : R) (f : R -> R) (t a : R), k = INR (S m) -> is_derive f t a ->
  is_derive (fun s => f s ^ S m) t (k * f t ^ m * a).
Proof.
  intros m k f t a -> F. apply (D_same _ t (INR (S m) * a * f t ^ pred (S m))).
  - apply (is_derive_pow f (S m) t a). assumption.
  - simpl pred. ring.
Qed.

Lemma D_id : forall t : R, is_derive (fun s : R => s) t 1.
Proof. intros. apply (is_derive_id t). Qed.

Lemma D_exp : forall (f : R -> R) (t a : R), is_derive f t a -> is_derive (fun s => exp (f s)) t (exp (f t) * a).
Proof.
  intros. apply (D_same _ t (a * exp (f t))); [|ring].
  apply (is_derive_comp exp f t (exp (f t)) a); [apply is_derive_exp|assumption].
Qed.

Lemma D_ln : forall (f : R -> R) (t a : R), is_derive f t a -> 0 < f t -> is_derive (fun s => ln (f s)) t (a / f t).
Proof.
  intros. apply (is_derive_comp ln f t (/ f t) a); [apply is_derive_ln; assumption|assumption].
Qed.

Lemma D_sin : forall (f : R -> R) (t a : R), is_derive f t a -> is_derive (fun s => sin (f s)) t (cos (f t) * a).
Proof.
  intros. apply (D_same _ t (a * cos (f t))); [|ring].
  apply (is_derive_comp sin f t (cos (f t)) a); [apply is_derive_sin|assumption].
Qed.

Lemma D_cos : forall (f : R -> R) (t a : R), is_derive f t a -> is_derive (fun s => cos (f s)) t (- sin (f t) * a).
Proof.
  intros. apply (D_same _ t (a * - sin (f t))); [|ring].
  apply (is_derive_comp cos f t (- sin (f t)) a); [apply is_derive_cos|assumption].
Qed.

Lemma D_arctan : forall (f : R -> R) (t a : R), is_derive f t a ->
  is_derive (fun s => atan (f s)) t (a / (1 + f t * f t)).
Proof.
  intros f t a F. apply (is_derive_comp atan f t (/ (1 + f t * f t)) a); [|assumption].
  replace (f t * f t) with (f t ^ 2) by ring. apply is_derive_Reals. apply derivable_pt_lim_atan.
Qed.

Lemma D_tanh : forall (f : R -> R) (t a : R), is_derive f t a ->
  is_derive (fun s => tanh (f s)) t ((1 - tanh (f t) ^ 2) * a).
Proof.
  intros f t a F. apply (D_same _ t (a * (1 - tanh (f t) ^ 2))); [|ring].
  apply (is_derive_comp tanh f t (1 - tanh (f t) ^ 2) a); [|assumption].
  set (x := f t). pose proof (exp_pos (2 * x)) as P.
  apply (is_derive_ext (fun y => (exp (2 * y) - 1) / (exp (2 * y) + 1))); [intro; symmetry; apply tanh_exp|].
  assert (Q : is_derive (fun y => exp (2 * y)) x (exp (2 * x) * (2 * 1))).
  { apply (D_exp (fun y => 2 * y)). apply (D_scale (fun y => y)). apply D_id. }
  eapply D_same.
  - apply (D_divide (fun y => exp (2 * y) - 1) (fun y => exp (2 * y) + 1)).
    + apply (D_minus (fun y => exp (2 * y)) (fun _ => 1)); [exact Q|apply D_const].
    + apply (D_plus (fun y => exp (2 * y)) (fun _ => 1)); [exact Q|apply D_const].
    + lra.
  - rewrite tanh_exp. field. lra.
Qed.

Lemma D_bigsum : forall n (f : nat -> R -> R) (t : R) (d : nat -> R), (forall i, is_derive (f i) t (d i)) ->
  is_derive (fun s => bigsum n (fun i => f i s)) t (bigsum n d).
Proof.
  intros n f t d H. induction n as [|n IH]; simpl; [apply D_const|].
  apply (D_plus (fun s => bigsum n (fun i => f i s)) (f n)); [exact IH|apply H].
Qed.

(* a motion through a point with a rate *)
Lemma motion : forall t q r : R, { x : R -> R | x t = q /\ is_derive x t r }.
Proof.
  intros t q r. exists (fun s => q + r * (s - t)). split; [ring|].
  apply (D_same _ t (0 + r * (1 - 0))); [|ring]. apply (D_plus (fun _ => q) (fun s => r * (s - t))); [apply D_const|].
  apply (D_scale (fun s => s - t)). apply (D_minus (fun s => s) (fun _ => t)); [apply D_id|apply D_const].
Qed.

Lemma motions : forall t q r : R,
  { x : nat -> R -> R | (forall i, x i t = q) /\ (forall i, is_derive (x i) t r) }.
Proof. intros t q r. destruct (motion t q r) as [x [A D]]. exists (fun _ => x). split; intros _; assumption. Qed.

(* rule nonincreasing: a function whose derivative is never positive from time zero to t is at t at most what it was *)
Lemma nonincreasing : forall (f d : R -> R) (t : R), 0 <= t ->
  (forall s, 0 <= s <= t -> is_derive f s (d s)) -> (forall s, 0 <= s <= t -> d s <= 0) -> f t <= f 0.
Proof.
  intros f d t T D N. destruct (Req_dec t 0) as [->|Z]; [lra|].
  destruct (MVT_gen f 0 t d) as [c [A E]].
  - intros x A. rewrite Rmin_left, Rmax_right in A by lra. apply D. lra.
  - intros x A. rewrite Rmin_left, Rmax_right in A by lra. apply continuity_pt_filterlim.
    apply (ex_derive_continuous f x). exists (d x). apply D. lra.
  - rewrite Rmin_left, Rmax_right in A by lra. assert (d c * (t - 0) <= 0 * (t - 0)); [|lra].
    apply Rmult_le_compat_r; [lra|apply N; lra].
Qed.

(* what has the rate 0 from time zero to t is at each instant between what it is at t *)
Lemma constant : forall (f : R -> R) (t : R), (forall s, 0 <= s <= t -> is_derive f s 0) ->
  forall s, 0 <= s <= t -> f s = f t.
Proof.
  intros f t D s S. destruct (MVT_gen f s t (fun _ => 0)) as [c [_ E]].
  - intros x A. rewrite Rmin_left, Rmax_right in A by lra. apply D. lra.
  - intros x A. rewrite Rmin_left, Rmax_right in A by lra. apply continuity_pt_filterlim.
    apply (ex_derive_continuous f x). exists 0. apply D. lra.
  - lra.
Qed.

(* rule monotone: where the derivative is not negative from a to x, a function is at x at least what it is at a *)
Lemma monotone : forall (f d : R -> R) (a x : R), a <= x ->
  (forall s, a <= s <= x -> is_derive f s (d s)) -> (forall s, a <= s <= x -> d s >= 0) -> f a <= f x.
Proof.
  intros f d a x A D N. destruct (MVT_gen f a x d) as [c [C E]].
  - intros s S. rewrite Rmin_left, Rmax_right in S by lra. apply D. lra.
  - intros s S. rewrite Rmin_left, Rmax_right in S by lra. apply continuity_pt_filterlim.
    apply (ex_derive_continuous f s). exists (d s). apply D. lra.
  - rewrite Rmin_left, Rmax_right in C by lra. assert (0 * (x - a) <= d c * (x - a)); [|lra].
    apply Rmult_le_compat_r; [lra|]. apply Rge_le, N. lra.
Qed.

(* the same down to x, where the derivative is not positive *)
Lemma monotone_down : forall (f d : R -> R) (a x : R), x <= a ->
  (forall s, x <= s <= a -> is_derive f s (d s)) -> (forall s, x <= s <= a -> d s <= 0) -> f a <= f x.
Proof.
  intros f d a x A D N. apply Ropp_le_cancel.
  apply (monotone (fun s => - f s) (fun s => - d s) x a A); intros s S.
  - apply D_opp, D, S.
  - specialize (N s S). lra.
Qed.

Lemma monotone_ge : forall (f d : R -> R) (a x : R), a <= x ->
  (forall s, a <= s <= x -> is_derive f s (d s)) -> (forall s, a <= s <= x -> d s >= 0) -> f a >= 0 -> f x >= 0.
Proof. intros f d a x A D N S. pose proof (monotone f d a x A D N). lra. Qed.

Lemma monotone_gt : forall (f d : R -> R) (a x : R), a <= x ->
  (forall s, a <= s <= x -> is_derive f s (d s)) -> (forall s, a <= s <= x -> d s >= 0) -> f a > 0 -> f x > 0.
Proof. intros f d a x A D N S. pose proof (monotone f d a x A D N). lra. Qed.

(* a point that is a root: a continuous function of opposite signs at two numbers is zero between them *)
Lemma root_between : forall (f : R -> R) (a b : R), continuity f -> a <= b -> f a * f b <= 0 ->
  exists z, a <= z <= b /\ f z = 0.
Proof. intros f a b C A S. destruct (IVT_cor f a b C A S) as [z Z]. exists z. exact Z. Qed.
