(* What the exported certificates use: sums over n neurons, the sign function, the rules of the checker, each a lemma. *)
Require Import Reals Lra Lia.
Open Scope R_scope.

(* --- what statements are written with --- *)

(* f 0 + ... + f (n - 1): Sum(...) over an index, for any n, also none. *)
Fixpoint bigsum (n : nat) (f : nat -> R) : R :=
  match n with O => 0 | S m => bigsum m f + f m end.

Definition sgn (x : R) : R :=
  match total_order_T x 0 with inleft (left _) => -1 | inleft (right _) => 0 | inright _ => 1 end.

(* --- names for values --- *)

Lemma named : forall x : R, { y : R | y = x }.
Proof. intro x. exists x. reflexivity. Qed.

Lemma named_each : forall f : nat -> R, { g : nat -> R | forall i, g i = f i }.
Proof. intro f. exists f. reflexivity. Qed.

(* --- sums --- *)

Lemma bigsum_ext : forall n f g, (forall i, (i < n)%nat -> f i = g i) -> bigsum n f = bigsum n g.
Proof.
  intros n f g. induction n as [|n IH]; intros H; simpl; [reflexivity|].
  rewrite IH by (intros; apply H; lia). rewrite (H n) by lia. reflexivity.
Qed.

Lemma bigsum_scal : forall n c f, bigsum n (fun i => c * f i) = c * bigsum n f.
Proof. intros n c f. induction n as [|n IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma bigsum_plus : forall n f g, bigsum n (fun i => f i + g i) = bigsum n f + bigsum n g.
Proof. intros n f g. induction n as [|n IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma bigsum_zero : forall n f, (forall i, (i < n)%nat -> f i = 0) -> bigsum n f = 0.
Proof.
  intros n f. induction n as [|n IH]; intros H; simpl; [reflexivity|].
  rewrite IH by (intros; apply H; lia). rewrite (H n) by lia. ring.
Qed.

Lemma bigsum_nonneg : forall n f, (forall i, (i < n)%nat -> 0 <= f i) -> 0 <= bigsum n f.
Proof.
  intros n f. induction n as [|n IH]; intros H; simpl; [lra|].
  assert (0 <= bigsum n f) by (apply IH; intros; apply H; lia). assert (0 <= f n) by (apply H; lia). lra.
Qed.

(* --- relations and their margins --- *)

Lemma le_of : forall a b m, b - a = m -> m >= 0 -> a <= b. Proof. intros; lra. Qed.
Lemma lt_of : forall a b m, b - a = m -> m > 0 -> a < b. Proof. intros; lra. Qed.
Lemma ge_of : forall a b m, a - b = m -> m >= 0 -> a >= b. Proof. intros; lra. Qed.
Lemma gt_of : forall a b m, a - b = m -> m > 0 -> a > b. Proof. intros; lra. Qed.
Lemma eq_of : forall a b m, a - b = m -> m = 0 -> a = b. Proof. intros; lra. Qed.
Lemma ne_of : forall a b m, a - b = m -> m <> 0 -> a <> b. Proof. intros; lra. Qed.
Lemma le_margin : forall a b m, a <= b -> b - a = m -> m >= 0. Proof. intros; lra. Qed.
Lemma lt_margin : forall a b m, a < b -> b - a = m -> m > 0. Proof. intros; lra. Qed.
Lemma ge_margin : forall a b m, a >= b -> a - b = m -> m >= 0. Proof. intros; lra. Qed.
Lemma gt_margin : forall a b m, a > b -> a - b = m -> m > 0. Proof. intros; lra. Qed.
Lemma eq_margin : forall a b m, a = b -> a - b = m -> m = 0. Proof. intros; lra. Qed.
Lemma ne_margin : forall a b m, a <> b -> a - b = m -> m <> 0. Proof. intros; lra. Qed.

(* --- rule combination: scale * value = total --- *)

Lemma combination_ge : forall s v t, 0 < s -> 0 <= t -> s * v = t -> v >= 0.
Proof.
  intros s v t Hs Ht E. apply Rle_ge. apply (Rmult_le_reg_l s); [exact Hs|]. rewrite E, Rmult_0_r. exact Ht.
Qed.

Lemma combination_gt : forall s v t, 0 < s -> 0 < t -> s * v = t -> v > 0.
Proof. intros s v t Hs Ht E. apply (Rmult_lt_reg_l s); [exact Hs|]. rewrite E, Rmult_0_r. exact Ht. Qed.

Lemma combination_eq : forall s v t, 0 < s -> t = 0 -> s * v = t -> v = 0.
Proof.
  intros s v t Hs Ht E. rewrite Ht in E. destruct (Rmult_integral _ _ E) as [Z|Z]; [lra|exact Z].
Qed.

(* the same with a sum over an index: the two sides agree outside of the sum and in each of its terms *)
Lemma combined_sum : forall n s a f b g, s * a = b -> (forall i, (i < n)%nat -> s * f i = g i) ->
  s * (a + bigsum n f) = b + bigsum n g.
Proof.
  intros n s a f b g A B. rewrite Rmult_plus_distr_l, A, <- bigsum_scal. rewrite (bigsum_ext n _ g B). reflexivity.
Qed.

Lemma add_split : forall n x a f y b g, x = a + bigsum n f -> y = b + bigsum n g ->
  x + y = (a + b) + bigsum n (fun i => f i + g i).
Proof. intros. subst. rewrite bigsum_plus. ring. Qed.

Lemma scale_split : forall n c a f, c * (a + bigsum n f) = c * a + bigsum n (fun i => c * f i).
Proof. intros. rewrite bigsum_scal. ring. Qed.

Lemma no_split : forall n x, x = x + bigsum n (fun _ => 0).
Proof. intros. rewrite bigsum_zero by reflexivity. ring. Qed.

(* --- signs of products --- *)

Lemma pos_ge : forall x, 0 < x -> 0 <= x. Proof. intros; lra. Qed.
Lemma gt_pos : forall x, x > 0 -> 0 < x. Proof. intros; lra. Qed.
Lemma ge_nonneg : forall x, x >= 0 -> 0 <= x. Proof. intros; lra. Qed.
Lemma eq_nonneg : forall x, x = 0 -> 0 <= x. Proof. intros; lra. Qed.
Lemma pos_ne : forall x, 0 < x -> x <> 0. Proof. intros; lra. Qed.
Lemma zero_last : forall a z, z = 0 -> a * z = 0. Proof. intros; subst; ring. Qed.
Lemma zero_first : forall a b, a = 0 -> a * b = 0. Proof. intros; subst; ring. Qed.
Lemma zero_plus : forall a b, a = 0 -> b = 0 -> a + b = 0. Proof. intros; subst; ring. Qed.
Lemma nothing : 0 >= 0. Proof. lra. Qed.
Lemma product_ne : forall a b, a <> 0 -> b <> 0 -> a * b <> 0.
Proof. intros a b A B E. destruct (Rmult_integral _ _ E); contradiction. Qed.
Lemma power_ne : forall a n, a <> 0 -> a ^ n <> 0. Proof. intros. apply pow_nonzero. assumption. Qed.
Lemma even_power : forall a n, 0 <= a ^ (2 * n). Proof. intros. rewrite pow_mult. apply pow_le, pow2_ge_0. Qed.
Lemma even_power_pos : forall a n, a <> 0 -> 0 < a ^ (2 * n).
Proof. intros. rewrite pow_mult. apply pow_lt. apply Rsqr_pos_lt in H. unfold Rsqr in H. simpl. lra. Qed.
Lemma square_nonneg : forall a, 0 <= a * a. Proof. intros. apply Rle_0_sqr. Qed.
Lemma square_pos : forall a, a <> 0 -> 0 < a * a. Proof. intros. apply Rsqr_pos_lt. assumption. Qed.
Lemma quotient_pos : forall a b, 0 < a -> 0 < b -> 0 < a / b.
Proof. intros. apply Rdiv_lt_0_compat; assumption. Qed.
Lemma quotient_nonneg : forall a b, 0 <= a -> 0 < b -> 0 <= a / b.
Proof. intros. apply Rmult_le_pos; [assumption|]. apply Rlt_le, Rinv_0_lt_compat. assumption. Qed.
Lemma quotient_ne : forall a b, a <> 0 -> b <> 0 -> a / b <> 0.
Proof. intros. apply product_ne; [assumption|]. apply Rinv_neq_0_compat. assumption. Qed.
Lemma inverse_pos : forall a, a > 0 -> 0 < / a. Proof. intros. apply Rinv_0_lt_compat. assumption. Qed.

(* --- facts --- *)

Lemma exp_tangent : forall x, 0 <= exp x - 1 - x.
Proof. intros x. destruct (Req_dec x 0) as [->|N]; [rewrite exp_0; lra|]. pose proof (exp_ineq1 x N). lra. Qed.

Lemma log_tangent : forall x, 0 < x -> 0 <= x - 1 - ln x.
Proof. intros x P. pose proof (exp_tangent (ln x)) as T. rewrite exp_ln in T by exact P. lra. Qed.

Lemma exp_minus_inv : forall x y, x = - y -> exp x = / exp y.
Proof. intros x y ->. apply exp_Ropp. Qed.

Lemma ln_reciprocal : forall a k, 0 < a -> k * a = 1 -> ln a = - ln k.
Proof.
  intros a k P E. assert (K : k = / a) by (field_simplify_eq; lra).
  rewrite K, ln_Rinv by exact P. ring.
Qed.

Lemma ln_one : forall a, a = 1 -> ln a = 0. Proof. intros a ->. apply ln_1. Qed.
Lemma exp_zero : forall a, a = 0 -> exp a = 1. Proof. intros a ->. apply exp_0. Qed.
Lemma exp_shift : forall a b c, a = b + c -> exp a = exp b * exp c. Proof. intros a b c ->. apply exp_plus. Qed.

Lemma exp_log_power : forall a (n : nat), 0 < a -> exp (INR n * ln a) = a ^ n.
Proof.
  intros a n P. induction n as [|n IH]; [simpl; rewrite Rmult_0_l; apply exp_0|].
  rewrite S_INR, Rmult_plus_distr_r, exp_plus, IH, Rmult_1_l, exp_ln by exact P. simpl. ring.
Qed.

Lemma exp_log_inverse_power : forall a (n : nat), 0 < a -> exp (- (INR n * ln a)) = / a ^ n.
Proof. intros. rewrite exp_Ropp, exp_log_power by assumption. reflexivity. Qed.

Lemma tanh_exp : forall x, tanh x = (exp (2 * x) - 1) / (exp (2 * x) + 1).
Proof.
  intros x. unfold tanh, sinh, cosh. pose proof (exp_pos x) as P. rewrite exp_Ropp.
  replace (2 * x) with (x + x) by ring. rewrite exp_plus. field.
  assert (0 < exp x * exp x) by (apply Rmult_lt_0_compat; exact P). lra.
Qed.

Lemma abs_of : forall x y, x = y -> Rabs x = Rabs y. Proof. intros; subst; reflexivity. Qed.
Lemma abs_turned : forall x y, x = - y -> Rabs x = Rabs y. Proof. intros x y ->. apply Rabs_Ropp. Qed.
Lemma sgn_pos : forall x, 0 < x -> sgn x = 1.
Proof. intros x P. unfold sgn. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma sgn_neg : forall x, x < 0 -> sgn x = -1.
Proof. intros x P. unfold sgn. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma sgn_zero : forall x, x = 0 -> sgn x = 0.
Proof. intros x P. unfold sgn. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma sgn_turned : forall x y, x = - y -> sgn x = - sgn y.
Proof. intros x y ->. unfold sgn. destruct (total_order_T (- y) 0) as [[|]|], (total_order_T y 0) as [[|]|]; lra. Qed.

Lemma max_abs : forall a b, Rmax a b = (a + b + Rabs (a - b)) / 2.
Proof. intros. unfold Rmax, Rabs. destruct (Rle_dec a b), (Rcase_abs (a - b)); lra. Qed.
Lemma min_abs : forall a b, Rmin a b = (a + b - Rabs (a - b)) / 2.
Proof. intros. unfold Rmin, Rabs. destruct (Rle_dec a b), (Rcase_abs (a - b)); lra. Qed.

Lemma abs_square : forall x, Rabs x * Rabs x - x * x = 0.
Proof. intros. unfold Rabs. destruct (Rcase_abs x); ring. Qed.
Lemma sqrt_squared : forall x, 0 <= x -> sqrt x * sqrt x - x = 0.
Proof. intros. rewrite sqrt_sqrt by assumption. ring. Qed.
Lemma sqrt_number : forall x y, 0 <= y -> x = y * y -> sqrt x = y.
Proof. intros x y P ->. apply sqrt_square. exact P. Qed.

Lemma not_zero : forall x, x <> 0 -> x = 0 -> False. Proof. intros x N Z. exact (N Z). Qed.

(* --- rule cases --- *)

Lemma two_cases : forall x, x >= 0 \/ - x >= 0. Proof. intros x. destruct (Rle_or_lt 0 x); [left|right]; lra. Qed.
Lemma three_cases : forall x, - x > 0 \/ x > 0 \/ x = 0.
Proof. intros x. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma abs_plus : forall x y, x >= 0 -> x = y -> Rabs y = x. Proof. intros. subst. apply Rabs_right. assumption. Qed.

(* --- tactics: nothing is trusted in them, the kernel sees what they make --- *)

(* an expression is not zero because a known one, which equals it up to ring laws, is not *)
Ltac nonzero :=
  repeat match goal with |- _ /\ _ => split end;
  solve [ assumption | lra
        | match goal with
          | N : ?p <> 0 |- ?q <> 0 => replace q with p by ring; exact N
          | N : ?p <> 0 |- ?q <> 0 => replace q with (- p) by ring; apply Ropp_neq_0_compat; exact N
          end
        | match goal with |- ?a * ?b <> 0 => apply product_ne; nonzero end
        | match goal with |- ?a ^ _ <> 0 => apply power_ne; nonzero end
        | match goal with |- / ?a <> 0 => apply Rinv_neq_0_compat; nonzero end ].

Ltac same := try reflexivity; solve [ ring | field; nonzero ].
